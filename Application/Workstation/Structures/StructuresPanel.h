#pragma once

#include "Bind.h"
#include "Panels.h"
#include "petrous/Presenters/WorkstationModel.h"

class QDoubleSpinBox;
class QLabel;
class QMenu;
class QSlider;
class QTreeView;
class QVBoxLayout;

namespace petrous::workstation
{

class StructuresModel;

/// Bone threshold and list of structures.
class StructuresPanel : public Panel
{
  Q_OBJECT
public:
  explicit StructuresPanel(presenters::WorkstationModel& model, QWidget* parent = nullptr);

  /// The selected structure; empty: none.
  QString chosen() const;

  void caseChanged() override;
  void appearanceChanged() override;

signals:
  void thicknessAsked(const QString& structure); ///< a second request turns it off
  void removalAsked(const QString& part);
  void renamingAsked(const QString& part);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void addThreshold(QVBoxLayout& layout);
  void addList(QVBoxLayout& layout);
  void fitColumns();
  void fitNames();
  void offer(const QPoint& position);
  void addTissues(QMenu& menu, const QString& name);
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
  Bindings m_bound;
};

} // namespace petrous::workstation
