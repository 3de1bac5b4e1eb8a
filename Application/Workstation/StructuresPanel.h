#pragma once

#include <QTimer>
#include <QWidget>

#include "petrous/Presenters/WorkstationModel.h"

class QSlider;
class QSpinBox;
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

  void caseChanged();
  void appearanceChanged();

private:
  void showIso();

  presenters::WorkstationModel& m_model;
  StructuresModel* m_structures;
  QTreeView* m_list;
  QSlider* m_slider;
  QSpinBox* m_box;
  QTimer m_apply; // a slider on the move makes one change, not fifty
};

} // namespace petrous::workstation
