#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "BackgroundWork.h"
#include "Bind.h"
#include "Panels.h"
#include "petrous/Presenters/AppearanceEditor.h"

class QBoxLayout;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QMenu;
class QPushButton;
class QSlider;

namespace petrous::workstation
{

class TransferPlot;

/// Transfer functions of bone and structures: plot, numbers, presets, files.
class AppearancePanel : public Panel
{
  Q_OBJECT
public:
  explicit AppearancePanel(presenters::WorkstationModel& model, QWidget* parent = nullptr);

  void caseChanged() override;
  void appearanceChanged() override;
  /// The parts that are selected in the list of structures: one alone is shown, now or when the
  /// panel is opened. A choice made here stays until another one is selected there.
  void follow(const std::vector<std::string>& parts);

  void partRenamed(const std::string& from, const std::string& to) override;
  const presenters::AppearanceEditor& editor() const noexcept { return m_editor; }

protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

private:
  void addChoices(QBoxLayout& layout);
  void addPointRow(QBoxLayout& layout);
  void addSurfaceRow(QBoxLayout& layout);
  void refresh();    // after the case or its looks changed
  void showEditor(); // as it is
  void showParts();
  void showSources();
  void showPoint();
  void showNote();
  void count();
  void attempt(const std::function<void()>& action); // shows why it failed
  void fillPresets(QMenu& menu);
  void fillFunction(QMenu& menu);
  void chooseColor();
  void setColor(const QColor& color);
  void savePreset();
  void copy();
  void paste();
  void importFile();
  void exportFile();

  presenters::WorkstationModel& m_model;
  presenters::AppearanceEditor m_editor;
  TransferPlot* m_plot;
  QComboBox* m_part;
  QComboBox* m_source;
  QLabel* m_note;
  QLabel* m_pointName;
  QDoubleSpinBox* m_value;
  QDoubleSpinBox* m_opacity;
  QDoubleSpinBox* m_specular;
  QPushButton* m_color;
  QPushButton* m_add;
  QPushButton* m_remove;
  QSlider* m_surface;
  QLabel* m_surfaceLabel;
  QString m_fault;                                  // of the last action
  std::pair<std::uint64_t, std::string> m_followed; // case (shownAs) and part last selected there
  std::optional<std::string> m_wanted;              // likewise, until the panel shows it
  Bindings m_bound;
  BackgroundWork m_work; // counts histograms
};

} // namespace petrous::workstation
