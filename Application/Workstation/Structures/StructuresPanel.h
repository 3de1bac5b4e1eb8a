#pragma once

#include <QTimer>
#include <QWidget>

#include "petrous/Presenters/WorkstationModel.h"

class QDoubleSpinBox;
class QMenu;
class QSlider;
class QTreeView;

namespace petrous::workstation
{

class StructuresModel;

/// The bone's threshold and the list of structures.
class StructuresPanel : public QWidget
{
  Q_OBJECT
public:
  explicit StructuresPanel(presenters::WorkstationModel& model, QWidget* parent = nullptr);

  /// The structure of the row that is chosen; empty: none.
  QString chosen() const;

  void caseChanged();
  void appearanceChanged();

signals:
  void thicknessAsked(const QString& structure); ///< again: no longer

private:
  void offer(const QPoint& position);
  void addTissues(QMenu& menu, const QString& name);
  void showIso();
  void showRange();

  presenters::WorkstationModel& m_model;
  StructuresModel* m_structures;
  QTreeView* m_list;
  QSlider* m_slider;
  QDoubleSpinBox* m_box;
  double m_step = 1.0; // of the slider, in the CT's unit
  QTimer m_apply;      // a slider on the move makes one change, not fifty
};

} // namespace petrous::workstation
