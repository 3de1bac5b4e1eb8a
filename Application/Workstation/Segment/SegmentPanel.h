#pragma once

#include <array>
#include <functional>

#include <QTimer>

#include "Bind.h"
#include "Panels.h"
#include "petrous/Presenters/SegmentEditor.h"

class QAction;
class QFormLayout;
class QLabel;
class QLineEdit;
class QMenu;
class QProgressBar;
class QPushButton;
class QStackedWidget;
class QToolButton;
class QTreeWidget;
class QVBoxLayout;

namespace petrous::workstation
{

/// The structure that is being made: name, tools with their values, volume, and what becomes of it.
class SegmentPanel : public Panel
{
  Q_OBJECT
public:
  using Tool = presenters::SegmentEditor::Tool;

  /// `tools` are shown as buttons, in their order.
  SegmentPanel(presenters::SegmentEditor& editor, const std::vector<QAction*>& tools,
               QWidget* parent = nullptr);

  void caseChanged() override;
  void appearanceChanged() override;
  void refresh();
  void showWork(bool works);
  void showVolume(); ///< alone, while a stroke is painted
  void setProgress(double fraction, const QString& text, const QString& left);
  void partsChanged() override;
  void say(const QString& line);      ///< what was done; empty: nothing
  void withdraw(const QString& line); ///< if it was said last
  void complain(const QString& line); ///< a refusal, which goes with the next change
  void focusName();

signals:
  void stepAsked();
  void cancelAsked(); ///< of the work under way
  void undoAsked();
  void redoAsked();
  void createAsked();
  void discardAsked();
  void editAsked(const QString& structure);
  void imageWanted(const QString& image);           ///< in the slices
  void pointChosen(const Eigen::Vector3d& patient); ///< of the nerve
  void pointToCrosshairAsked(int row);              ///< likewise

private:
  using Values = presenters::SegmentValues;

  void addHead(QVBoxLayout& layout);
  void addTools(QVBoxLayout& layout, const std::vector<QAction*>& tools);
  void addPages(QVBoxLayout& layout);
  QWidget* addFoot();
  double shownRadius() const; // of the nerve, mm
  QWidget* page(const QString& help, const std::function<void(QFormLayout&)>& fill,
                const QString& step);
  void addRange(QFormLayout& form, const char* lower, const char* upper);
  void addBrush(QFormLayout& form, const char* radius, const char* shape, const char* within);
  QWidget* nervePage();
  void change(const std::function<void(Values&)>& what);
  void showRange();
  void showSources();
  QString imageName(const std::string& source) const;
  void takeSource(const std::string& source);
  void showPoints();
  int chosenPoint() const; ///< -1: none
  void enablePoints();

  presenters::SegmentEditor& m_editor;
  QLineEdit* m_name;
  QPushButton* m_edit;
  QMenu* m_editable;
  QComboBox* m_source;
  QStackedWidget* m_pages;
  std::vector<QDoubleSpinBox*> m_ranges;
  presenters::IntensityDisplay m_display; // of m_ranges
  std::vector<QPushButton*> m_steps;
  QTreeWidget* m_points = nullptr;
  QPushButton* m_removePoint = nullptr;
  QPushButton* m_movePoint = nullptr;
  QPushButton* m_pointUp = nullptr;
  QPushButton* m_pointDown = nullptr;
  QDoubleSpinBox* m_smallest = nullptr;
  QLabel* m_shown;
  QPushButton* m_showSource;
  QPushButton* m_takeShown;
  QLabel* m_volume;
  QLabel* m_line;
  QLabel* m_remark;
  QLabel* m_note;
  QLabel* m_pieces;
  QPushButton* m_keepLargest = nullptr;
  QProgressBar* m_progress;
  QPushButton* m_cancel;
  QPushButton* m_begun = nullptr; ///< the step that is computed, if a key began it
  QPushButton* m_undo;
  QPushButton* m_redo;
  QPushButton* m_create;
  QPushButton* m_discard;
  QTimer m_previewLater;
  bool m_showsPreview = false; ///< that one is being computed
  bool m_complains = false;
  Bindings m_bound;
};

} // namespace petrous::workstation
