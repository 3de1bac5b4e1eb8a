#pragma once

#include <optional>
#include <vector>

#include "Panels.h"
#include "petrous/Presenters/MeasurementEditor.h"
#include "petrous/Presenters/Measuring.h"

class QAction;
class QComboBox;
class QLabel;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace petrous::workstation
{

/// Tools, the list of what was measured with value and uncertainty, and the dimensions of
/// structures.
class MeasurePanel : public Panel
{
  Q_OBJECT
public:
  /// `tools` are shown as buttons, in their order.
  MeasurePanel(presenters::WorkstationModel& model, presenters::MeasurementEditor& editor,
               const std::vector<QAction*>& tools, QWidget* parent = nullptr);

  void caseChanged() override;
  void partsChanged() override;
  void partRenamed(const std::string& from, const std::string& to) override;
  void stateChanged() override;
  QWidget* mainControl() override;
  void refresh();
  void say(const QString& line); ///< a refusal; empty: what the tool takes next
  void showBusy();               ///< a structure is being measured
  void showQuantities(const std::vector<presenters::Quantity>& quantities);
  void edit(std::size_t measurement); ///< its name

signals:
  void exportOffered(bool offered); ///< there is something to export
  void goToAsked(int measurement);
  void renamed(int measurement, const QString& name);
  void shownAsked(int measurement, bool shown);
  void removalAsked(int measurement);
  void chosenChanged(int measurement); ///< -1: none
  void exportAsked();
  void copyAsked(int measurement); ///< -1: all
  /// Dimensions of a structure; with another one the distance between them.
  void structureAsked(const QString& structure, const QString& other);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  int chosen() const;
  void fillStructures();
  void enableExport();
  void takeItem(QTreeWidgetItem* item, int column);

  presenters::WorkstationModel& m_model;
  presenters::MeasurementEditor& m_editor;
  QTreeWidget* m_list;
  QLabel* m_hint;
  QLabel* m_empty;
  QString m_refusal;
  QComboBox* m_structure;
  QComboBox* m_other;
  QPushButton* m_measure;
  QPushButton* m_export;
  QTreeWidget* m_quantities;
  std::vector<QPushButton*> m_ofOne;
  std::vector<QPushButton*> m_ofAny;
  bool m_showing = false;
};

/// Of a kind of measurement, in every view: colours that colour-blind users tell apart.
QColor measureColor(scene::Measurement::Kind kind);

} // namespace petrous::workstation
