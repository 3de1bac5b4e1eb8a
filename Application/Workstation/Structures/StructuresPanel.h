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

/// Bone threshold and list of structures.
class StructuresPanel : public QWidget
{
  Q_OBJECT
public:
  explicit StructuresPanel(presenters::WorkstationModel& model, QWidget* parent = nullptr);

  /// The selected structure; empty: none.
  QString chosen() const;

  void caseChanged();
  void appearanceChanged();

signals:
  void thicknessAsked(const QString& structure); ///< a second request turns it off

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
  QTimer m_apply;      // coalesces the changes of a moving slider
};

} // namespace petrous::workstation
