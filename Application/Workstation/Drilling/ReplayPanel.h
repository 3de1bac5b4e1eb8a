#pragma once

#include <functional>

#include "Panels.h"
#include "petrous/Presenters/SessionReview.h"

class QAction;
class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;
class QSlider;
class QToolButton;
class QTreeWidget;

namespace petrous::workstation
{

class ForceCourse;

/// A recorded operation: which one, its place in time, the force over time, and its metrics, of the
/// whole and of each of its recordings.
class ReplayPanel : public Panel
{
  Q_OBJECT
public:
  explicit ReplayPanel(QAction& play, QWidget* parent = nullptr);

  void setRecordings(const QStringList& names, int current); ///< -1: none is chosen
  /// nullptr: none. It must stay as long as it is shown.
  void setReview(const presenters::OperationReview* review);
  void setTime(double seconds);
  void say(const QString& text); ///< what is going on, or went wrong; empty: nothing

  double speed() const;
  bool showsGhost() const;
  bool startsWithDrill() const;

  // What the panel hears it hears through its controller.
  std::function<void()> onCaseChanged, onPartsChanged, onRecordingsChanged, onToolMoved;
  void caseChanged() override;
  void partsChanged() override;
  void attachmentsChanged() override;
  void toolMoved(const presenters::MeasuredTool& tool, const haptics::Pose& pose) override;
  void toolGone() override;

signals:
  void recordingChosen(int row);
  void openAsked();
  void seekAsked(int milliseconds);
  void ghostAsked(bool on);
  void exportAsked();

private:
  void showParts();
  void showMetrics();
  const presenters::SessionReview& chosenPart() const;

  const presenters::OperationReview* m_review = nullptr;
  QComboBox* m_recordings;
  QSlider* m_place;
  QLabel* m_time;
  QLabel* m_now;
  QLabel* m_said;
  QComboBox* m_speed;
  QCheckBox* m_ghost;
  QCheckBox* m_withDrill;
  ForceCourse* m_force;
  QTreeWidget* m_parts; ///< the whole and the parts, if there are several
  QTreeWidget* m_metrics;
  QTreeWidget* m_structures;
  QLabel* m_note;
  QPushButton* m_export;
  bool m_refreshing = false;
};

} // namespace petrous::workstation
