#pragma once

#include <functional>

#include <QWidget>

#include "Bind.h"
#include "petrous/Presenters/RegistrationSession.h"

class QComboBox;
class QFormLayout;
class QLabel;
class QSpinBox;

namespace petrous::workstation
{

/// Settings of a registration: start, region of the CT, target image, and where its error is
/// estimated.
class RegistrationTargetBox : public QWidget
{
  Q_OBJECT
public:
  explicit RegistrationTargetBox(presenters::RegistrationSession& session,
                                 QWidget* parent = nullptr);

  void refresh(); ///< updates the choices

signals:
  void chosen();

private:
  void addStart();
  void addOnto();
  void addPlace();
  void addBox();
  void addChoice(const QString& label, QComboBox* box);
  void fillPlaces();
  void showPlaceNote();
  /// Changes the session's aim.
  void choose(const std::function<void(presenters::RegistrationAim&)>& change);

  presenters::RegistrationSession& m_session;
  QFormLayout* m_form;
  QComboBox* m_start;
  QSpinBox* m_box;
  QComboBox* m_onto;
  QComboBox* m_place;
  QLabel* m_placeNote;
  Bindings m_bound;
};

} // namespace petrous::workstation
