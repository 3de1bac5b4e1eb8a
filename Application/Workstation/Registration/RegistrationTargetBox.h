#pragma once

#include <QWidget>

#include "petrous/Presenters/RegistrationSession.h"

class QComboBox;
class QFormLayout;
class QSpinBox;

namespace petrous::workstation
{

/// What a registration begins from, what counts of the CT, to what it goes, and where its error is
/// stated.
class RegistrationTargetBox : public QWidget
{
  Q_OBJECT
public:
  explicit RegistrationTargetBox(presenters::RegistrationSession& session, QWidget* parent = nullptr);

  void refresh(); ///< what there is to choose from

signals:
  void chosen();

private:
  void addStart();
  void addOnto();
  void addPlace();
  void addBox();
  QComboBox* addChoice(const QString& label, const char* name, const QString& tip);
  void fillPlaces();
  void choose(); // what the boxes show

  presenters::RegistrationSession& m_session;
  QFormLayout* m_form;
  QComboBox* m_start;
  QComboBox* m_onto;
  QComboBox* m_place;
  QSpinBox* m_box;
  bool m_showing = true; // what the session says, not what the user wants
};

} // namespace petrous::workstation
