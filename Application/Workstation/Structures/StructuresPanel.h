#pragma once

#include <string>
#include <utility>
#include <vector>

#include <QTimer>

#include "Bind.h"
#include "Panels.h"
#include "petrous/Presenters/StructureList.h"

class QAction;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QMenu;
class QModelIndex;
class QSlider;
class QToolButton;
class QTreeView;
class QVBoxLayout;

namespace petrous::workstation
{

class StructureEditor;
class StructuresModel;

/// Bone threshold, list of structures with a search, and the properties of those selected.
class StructuresPanel : public Panel
{
  Q_OBJECT
public:
  explicit StructuresPanel(presenters::WorkstationModel& model, QWidget* parent = nullptr);

  /// The selected structure; empty: none.
  QString chosen() const;
  /// The selected parts that the search shows, as WorkstationModel::lookOf; of a kind all of it.
  std::vector<std::string> selectedParts() const;

  void caseChanged() override;
  void partsChanged() override;
  void partRenamed(const std::string& from, const std::string& to) override;
  void appearanceChanged() override;
  void toolGone() override;
  QWidget* mainControl() override;
  bool showsNear() const override { return isVisible(); }
  void toolMeasured(const presenters::ToolSurroundings& near) override;

signals:
  void thicknessAsked(const QString& structure); ///< a second request turns it off
  void selected();                               ///< perhaps others than before
  void removalAsked(const QString& part);
  void renamingAsked(const QString& part);
  void axesAsked(const QString& part); ///< are to be corrected

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void addThreshold(QVBoxLayout& layout);
  void addSearch(QVBoxLayout& layout);
  void addList(QVBoxLayout& layout);
  void addActions();
  void rebuild(bool another);
  void filter();
  void selectionChanged();
  bool clicked(const QPoint& position, Qt::KeyboardModifiers modifiers);
  void setShown(const std::vector<std::string>& parts, bool shown);
  void toggleShown();
  void onlyThese(const std::vector<std::string>& parts);
  void chooseColor();
  std::vector<std::string> partsOf(const QModelIndex& row) const;
  QString titleOf(const std::vector<std::string>& parts) const;
  void fitColumns();
  void fitNames();
  void offer(const QPoint& position);
  void showRange();
  bool isOnMr() const; // an MR is the primary image, and shows no bone

  presenters::WorkstationModel& m_model;
  StructuresModel* m_structures;
  QTreeView* m_list;
  QSlider* m_slider;
  QDoubleSpinBox* m_box;
  QLabel* m_threshold;
  QLabel* m_count;
  double m_step = 1.0; // of the slider, in the primary image's unit
  int m_nameWidth = 0; // of the names' column as the user set it, px; 0: not set
  bool m_fitting = false;
  QLineEdit* m_search;
  QToolButton* m_only;
  StructureEditor* m_editor;
  presenters::OnlyThese m_alone;
  /// Parts that got another name since the list was made, in that order: from, to.
  std::vector<std::pair<std::string, std::string>> m_renamed;
  QTimer m_fitLater;               // one fit for all that changed
  std::vector<QAction*> m_actions; // of the context menu
  Bindings m_bound;
};

} // namespace petrous::workstation
