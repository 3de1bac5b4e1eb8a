#pragma once

#include <cstdint>
#include <optional>

#include "Panels.h"
#include "petrous/Presenters/ApproachTree.h"

class QAction;
class QLabel;
class QSlider;
class QTreeWidget;
class QTreeWidgetItem;

namespace petrous::workstation
{

class StrokeThumbnails;

/// The strokes of the case as a tree of its approaches, with pictures; the row that the user goes
/// to is the state that is shown. Below it the strokes of the present approach as a line that can
/// be dragged.
class ApproachPanel : public Panel
{
  Q_OBJECT
public:
  ApproachPanel(const presenters::WorkstationModel& model, StrokeThumbnails& thumbnails,
                QWidget* parent = nullptr);

  void caseChanged() override;
  void partsChanged() override;
  void appearanceChanged() override;
  void stateChanged() override;
  QWidget* mainControl() override;

signals:
  void stateAsked(const QString& approach, quint64 state);
  void approachAsked(const QString& approach); ///< in the state in which it was left
  void startAsked();                           ///< a new one from the present state
  void renamingAsked(const QString& approach);
  void removalAsked(const QString& approach);
  void comparisonAsked(const QString& approach); ///< with the present one

protected:
  void showEvent(QShowEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override; ///< of the tree's area

private:
  void addActions();
  void add(QTreeWidgetItem* above, const presenters::ApproachNode& node);
  void fill();
  void showPresent();
  void go(QTreeWidgetItem* item);
  void slide(int strokes);
  void enable();
  void wantThumbnails();
  QTreeWidgetItem* itemOf(const QString& approach, std::size_t state) const;
  QString chosen() const; ///< the approach of the current row

  const presenters::WorkstationModel& m_model;
  StrokeThumbnails& m_thumbnails;
  QTreeWidget* m_tree;
  QSlider* m_line;
  QLabel* m_place;
  QAction* m_start;
  QAction* m_rename;
  QAction* m_remove;
  QAction* m_compare;
  std::optional<std::uint64_t> m_shown; // the case, as WorkstationModel::shownAs; 0: none
  std::uint64_t m_changes = 0;          // Dissection::changes, likewise
  bool m_isFilling = false;
};

} // namespace petrous::workstation
