#pragma once

#include <optional>

#include "Bind.h"
#include "Panels.h"
#include "petrous/Presenters/RegistrationSession.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QSlider;
class QVBoxLayout;

namespace petrous::workstation
{

class FittedBox;
class FoldBox;
class HandlesBox;
class LandmarksBox;
class MetricCurve;
class RegistrationTargetBox;

/// Registration of an MR of the case: display, fit, manual motion, landmarks, sign-off.
class RegistrationPanel : public Panel
{
  Q_OBJECT
public:
  explicit RegistrationPanel(presenters::RegistrationSession& session, QWidget* parent = nullptr);

  void caseChanged() override;
  void partsChanged() override;
  void stateChanged() override;
  void refresh(); ///< registration, landmarks, undo state
  void setOverlay(const std::optional<presenters::OverlayMode>& mode, double opacity);
  void setRunning(bool running);
  void setProgress(double fraction, const QString& text, const QString& left);
  void setMetric(const QString& text); ///< at the current registration
  void say(const QString& line);       ///< an error, or what to do next; empty: nothing
  void openPoints();
  void openHand();
  MetricCurve& curve() { return *m_curve; }

signals:
  void overlayChosen(const std::optional<petrous::presenters::OverlayMode>& mode);
  void opacityChosen(double opacity);
  void mrChosen();
  void registerAsked();
  void refineAsked(); ///< from the current registration
  void cancelAsked();
  void pointAsked();     ///< of a pair, at the crosshair
  void landmarksAsked(); ///< apply the landmark fit
  void landmarksChanged();
  void aimChosen();
  void shown();
  void hidden(); ///< the metric is no longer needed

protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

private:
  void addSteps(QVBoxLayout& layout);
  void addSeeing(QVBoxLayout& layout);
  void addRunning(QVBoxLayout& layout);
  QWidget* signOff();
  void attempt(const std::function<void()>& what); ///< reports exceptions
  void sign();
  void enable();
  void showSteps();

  presenters::RegistrationSession& m_session;
  QComboBox* m_mr;
  QLabel* m_state;
  QLabel* m_error;
  QLabel* m_line;
  std::optional<presenters::OverlayMode> m_overlayMode; ///< none: CT alone
  double m_overlayOpacity = 0.5;
  FittedBox* m_overlay;
  QSlider* m_opacity;
  QWidget* m_opacityLabel;
  QPushButton* m_undo;
  QPushButton* m_redo;
  QPushButton* m_remove;
  QPushButton* m_register;
  QPushButton* m_refine;
  QPushButton* m_cancel;
  QProgressBar* m_progress;
  MetricCurve* m_curve;
  QLabel* m_metric;
  RegistrationTargetBox* m_aim;
  HandlesBox* m_handles;
  LandmarksBox* m_points;
  FoldBox* m_pointsFold;
  FoldBox* m_handFold;
  QLineEdit* m_name;
  QPushButton* m_sign;
  bool m_running = false;
  Bindings m_bound;
};

} // namespace petrous::workstation
