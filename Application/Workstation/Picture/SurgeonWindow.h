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

/// The scene on a whole screen, for the eyes of the surgeon: on a second screen where there is one.
/// Esc closes it.
///
/// It can be turned and drilled in as the main view can, which it follows; its keys are the main
/// window's. With two buffers (StereoMode::QuadBuffer) it only shows: the hands stay in the main
/// window.
class SurgeonWindow : public QWidget
{
  Q_OBJECT
public:
  SurgeonWindow(ThreeDView& main, bool quadBuffer);
  ~SurgeonWindow() override;

  bool quadBuffer() const noexcept { return m_stereoView != nullptr; }
  SceneDisplay& display() noexcept;

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
