#pragma once

#include "Bind.h"
#include "Panels.h"
#include "petrous/Presenters/IntensityDisplay.h"

class QDoubleSpinBox;
class QFormLayout;

namespace petrous::workstation
{

class FittedBox;
class SliceColumn;
class SliceController;
class WindowSettings;

/// A grey window's name in the window's language, if it is one of ours.
QString windowName(const std::string& name);

/// Planes, grey window, slab and zoom of the slices, by number.
class SlicesPanel : public Panel
{
  Q_OBJECT
public:
  SlicesPanel(presenters::WorkstationModel& model, SliceColumn& slices, SliceController& controller,
              WindowSettings& kept, QWidget* parent = nullptr);

  void refresh();
  void caseChanged() override;
  QString windowKind() const; ///< of the user's own windows: Hounsfield units, MR, other values

private:
  void addPlanes(QFormLayout* form);
  void addWindow(QFormLayout* form);
  void addSlab(QFormLayout* form);
  void addZoom(QFormLayout* form);
  void fillWindows();
  void keepWindow();
  void forgetWindow();

  presenters::WorkstationModel& m_model;
  SliceColumn& m_slices;
  SliceController& m_controller;
  WindowSettings& m_kept;
  Bindings m_bound;
  std::vector<presenters::NamedWindow> m_offered; ///< as in m_windows
  int m_own = 0;                                  ///< the first of the user's
  FittedBox* m_windows = nullptr;
  QDoubleSpinBox* m_width = nullptr;
  QDoubleSpinBox* m_level = nullptr;
  QWidget* m_forget = nullptr;
  QWidget* m_keep = nullptr;
};

} // namespace petrous::workstation
