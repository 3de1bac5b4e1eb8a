#pragma once

#include <memory>

#include <QWidget>

#include <vtkSmartPointer.h>

class QScreen;
class QVTKOpenGLStereoWidget;
class vtkGenericOpenGLRenderWindow;

namespace petrous::workstation
{

class SceneDisplay;
class ThreeDView;

/// The scene in full screen for the surgeon: on a second screen if there is one. Esc closes it.
///
/// Follows the main view and accepts the same rotation and drilling input; its keys are the main
/// window's. With quad-buffered stereo (StereoMode::QuadBuffer) it is output only: input stays in
/// the main window.
class SurgeonWindow : public QWidget
{
  Q_OBJECT
public:
  SurgeonWindow(ThreeDView& main, bool quadBuffer);
  ~SurgeonWindow() override;

  bool quadBuffer() const noexcept { return m_stereoView != nullptr; }
  SceneDisplay& display() noexcept;

  /// While a dialog asks about the case in the main window: no input is taken here either, and a
  /// tool that was pressed is let go. Qt blocks it for dialogs of the whole program only.
  void setBlocked(bool blocked);
  /// Fills the first screen that `other` is not on, else that of `other`.
  void showBeside(const QWidget& other);

signals:
  void closed();

protected:
  void keyPressEvent(QKeyEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

private:
  void addView();
  void addStereoView();

  ThreeDView& m_main;
  ThreeDView* m_view = nullptr;
  QVTKOpenGLStereoWidget* m_stereoView = nullptr;
  vtkSmartPointer<vtkGenericOpenGLRenderWindow> m_window; // of m_stereoView
  std::unique_ptr<SceneDisplay> m_stereoDisplay;
};

} // namespace petrous::workstation
