#include "petrous/Presenters/RegistrationSession.h"

#include <cstdio>
#include <utility>

#include "petrous/Registration/Landmarks.h"
#include "petrous/Scene/LayMr.h"

namespace petrous::presenters
{

namespace
{
using scene::Registration;

constexpr std::size_t kMostSteps = 1000;

Registration byHand()
{
  Registration how;
  how.method = Registration::Method::ByHand;
  return how;
}
} // namespace

RegistrationSession::RegistrationSession(WorkstationModel& model)
  : m_model(model)
{
}

void RegistrationSession::caseChanged()
{
  m_undo.clear();
  m_redo.clear();
  m_name.clear();
  choose(m_model.hasCase() && !m_model.value().mr.empty() ? m_model.value().mr.front().name
                                                          : std::string());
}

void RegistrationSession::choose(const std::string& mr)
{
  m_name = mr;
  m_landmarks.clear();
  m_fitted = part() ? part()->mrFromCt : core::RigidTransform();
}

const scene::ImagePart* RegistrationSession::part() const
{
  return m_model.hasCase() ? scene::findMr(m_model.value(), m_name) : nullptr;
}

std::vector<std::string> RegistrationSession::mrNames() const
{
  std::vector<std::string> names;
  if (m_model.hasCase())
    for (const scene::ImagePart& mr : m_model.value().mr)
      names.push_back(mr.name);
  return names;
}

std::string RegistrationSession::stateInWords() const
{
  return part() ? scene::registrationInWords(*part()) : std::string();
}

RegistrationSession::Lies RegistrationSession::lies() const
{
  Lies all;
  for (const scene::ImagePart& mr : m_model.value().mr)
    all.push_back({mr.name, mr.mrFromCt, mr.registered, mr.registration});
  return all;
}

void RegistrationSession::lay(const core::RigidTransform& mrFromCt, const Registration& how)
{
  if (!part() || m_model.drilling())
    return;
  change([&](scene::Case& value) { scene::layMr(value, m_name, mrFromCt, how); });
}

// What hears of the change finds that it can be undone.
void RegistrationSession::change(const std::function<void(scene::Case&)>& what)
{
  const Lies before = lies();
  m_model.changeMr(
      [&](scene::Case& value)
      {
        what(value);
        m_undo.push_back(before);
        m_redo.clear();
      });
  if (m_undo.size() > kMostSteps)
    m_undo.erase(m_undo.begin());
}

void RegistrationSession::moveByHand(const core::RigidTransform& mrFromCt)
{
  lay(mrFromCt, byHand());
}

void RegistrationSession::shift(const Eigen::Vector3d& millimetres)
{
  if (part())
    moveByHand(shifted(part()->mrFromCt, millimetres));
}

void RegistrationSession::turn(const Eigen::Vector3d& axis, double degrees)
{
  if (part())
    moveByHand(turned(part()->mrFromCt, axis, degrees, m_model.crosshair()));
}

void RegistrationSession::bringMiddleHere()
{
  if (part())
    moveByHand(broughtTo(part()->mrFromCt, part()->geometry.center(), m_model.crosshair()));
}

MrDifference RegistrationSession::movedByHand() const
{
  return part() ? difference(m_fitted, part()->mrFromCt, m_model.crosshair()) : MrDifference{};
}

void RegistrationSession::addLandmark()
{
  if (!part())
    return;
  if (m_landmarks.waitsForMr())
    m_landmarks.addMr(part()->mrFromCt * m_model.crosshair());
  else
    m_landmarks.addCt(m_model.crosshair());
}

void RegistrationSession::fitLandmarks()
{
  if (!part())
    return;
  std::vector<registration::LandmarkPair> pairs;
  for (const LandmarkList::Row& row : m_landmarks.rows())
    if (row.mr)
      pairs.push_back({row.ct, *row.mr});
  const registration::LandmarkFit fit = registration::fitLandmarks(pairs);
  Registration how;
  how.method = Registration::Method::Landmarks;
  char text[96];
  std::snprintf(text, sizeof text, "%zu pairs of points, %.2f mm apart (root mean square)",
                pairs.size(), fit.rms);
  how.text = text;
  m_fitted = fit.mrFromCt;
  lay(fit.mrFromCt, how);
}

registration::FitOptions RegistrationSession::fitOptions(bool search) const
{
  registration::FitOptions options;
  options.search = search;
  if (part() && part()->registered)
  {
    options.start = registration::Start::Given;
    options.given = part()->mrFromCt;
  }
  return options;
}

bool RegistrationSession::take(const registration::Registration& result, const std::string& place)
{
  if (!part() || m_model.drilling() || result.verdict == registration::Verdict::Failed)
    return false;
  Registration how;
  if (part()->registration && part()->registered)
  {
    how.method = part()->registration->method;
    how.refined = how.method != Registration::Method::MutualInformation;
  }
  how.verdict = result.verdict == registration::Verdict::Good ? Registration::Verdict::Good
                                                              : Registration::Verdict::Doubtful;
  how.text = result.text;
  how.metric = result.fit.metric;
  how.error = scene::RegistrationError{result.error.point, place, result.error.median,
                                       result.error.p95, result.error.max};
  m_fitted = result.fit.mrFromCt;
  lay(result.fit.mrFromCt, how);
  return true;
}

void RegistrationSession::keep(const core::RigidTransform& best)
{
  Registration how;
  how.text = "stopped before its end";
  m_fitted = best;
  lay(best, how);
}

void RegistrationSession::unregister()
{
  if (!part() || !part()->registered || m_model.drilling())
    return;
  change([this](scene::Case& value) { scene::unlayMr(value, m_name); });
}

void RegistrationSession::signOff(const std::string& who, const std::string& when)
{
  m_model.changeMr([&](scene::Case& value) { scene::signOff(value, m_name, who, when); });
}

void RegistrationSession::restore(const Lies& lies)
{
  m_model.changeMr(
      [&lies](scene::Case& value)
      {
        for (scene::ImagePart& mr : value.mr)
          for (const Lie& lie : lies)
            if (lie.name == mr.name)
            {
              const bool moved = (mr.mrFromCt.matrix() - lie.mrFromCt.matrix()).norm() > 0.0;
              mr.mrFromCt = lie.mrFromCt;
              mr.registered = lie.registered;
              mr.registration = lie.registration;
              if (moved && mr.registration)
                mr.registration->signOff.reset(); // whoever signed looks again
            }
      });
}

void RegistrationSession::undo()
{
  if (m_undo.empty() || m_model.drilling())
    return;
  m_redo.push_back(lies());
  const Lies back = std::move(m_undo.back());
  m_undo.pop_back();
  restore(back);
}

void RegistrationSession::redo()
{
  if (m_redo.empty() || m_model.drilling())
    return;
  m_undo.push_back(lies());
  const Lies forth = std::move(m_redo.back());
  m_redo.pop_back();
  restore(forth);
}

} // namespace petrous::presenters
