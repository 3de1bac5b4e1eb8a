#pragma once

#include <QWidget>

#include "petrous/Presenters/RegistrationSession.h"

class QComboBox;
class QFormLayout;
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
  QComboBox* addChoice(const QString& label, const char* name, const QString& tip);
  void fillPlaces();
  void choose(); // applies what the boxes show

  presenters::RegistrationSession& m_session;
  QFormLayout* m_form;
  QComboBox* m_start;
  QComboBox* m_onto;
  QComboBox* m_place;
  QSpinBox* m_box;
  bool m_showing = true; // values are being set from the session
};

} // namespace petrous::workstation
