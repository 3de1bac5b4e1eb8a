#include "petrous/Presenters/RegistrationSession.h"

#include <algorithm>
#include <map>
#include <utility>

#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/Placement.h"

namespace petrous::presenters
{

namespace
{
using scene::Registration;

Registration manualRegistration()
{
  Registration how;
  how.method = Registration::Method::ByHand;
  return how;
}

void checkLies(const std::optional<core::GridGeometry>& grid, const scene::ImagePart* mr)
{
  if (grid && (!mr || !core::sameGrid(*grid, mr->geometry)))
    throw core::Error(core::Fault::Refused,
                      "the axes of an MR were corrected while it was registered: the MR lies as "
                      "before; register it again");
}
} // namespace

RegistrationSession::RegistrationSession(WorkstationModel& model)
  : m_model(model)
{
}

void RegistrationSession::caseChanged()
{
  m_name.clear();
  m_aim = {};
  m_mrs = mrNames();
  choose(m_model.hasCase() && !m_model.value().mr.empty() ? m_model.value().mr.front().name
                                                          : std::string());
}

bool RegistrationSession::partsChanged()
{
  const std::vector<std::string> before = std::exchange(m_mrs, mrNames());
  const auto has = [](const std::vector<std::string>& names, const std::string& name)
  { return std::find(names.begin(), names.end(), name) != names.end(); };
  if (before.size() == m_mrs.size()) // one was renamed, or none
    for (std::size_t n = 0; n < before.size(); ++n)
      if (before[n] == m_name && !has(m_mrs, m_name))
      {
        m_name = m_mrs[n];
        break;
      }
  if (part() == nullptr && !(m_name.empty() && m_mrs.empty()))
  {
    caseChanged();
    return false;
  }
  followGrid();
  checkAim(); // a structure may be gone
  return true;
}

void RegistrationSession::choose(const std::string& mr)
{
  m_name = mr;
  m_landmarks.clear();
  m_grid.reset();
  followGrid();
  checkAim();
  m_fitted = part() ? part()->mrFromCt : core::RigidTransform();
}

// Where its axes were corrected the MR lies elsewhere in its own space, in which the landmarks are.
void RegistrationSession::followGrid()
{
  std::optional<core::GridGeometry> before = std::exchange(m_grid, std::nullopt);
  if (!part())
    return;
  m_grid = part()->geometry;
  if (!before || core::sameGrid(*before, *m_grid))
    return;
  m_landmarks.moveMr(*before, *m_grid);
  m_fitted = part()->mrFromCt;
}

bool RegistrationSession::preferUnregistered()
{
  if (!m_model.hasCase() || !m_landmarks.rows().empty())
    return false;
  const auto& mrs = m_model.value().mr;
  const auto isNot = [](const scene::ImagePart& mr) { return !mr.registered; };
  const auto wanted = std::find_if(mrs.rbegin(), mrs.rend(), isNot);
  if (wanted == mrs.rend() || (part() && isNot(*part())))
    return false;
  choose(std::string(wanted->name));
  return true;
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

std::string RegistrationSession::primary() const
{
  const bool isMr = m_model.hasCase() && m_model.value().ct.modality == scene::Modality::Mr;
  return isMr ? "primary MR" : "CT";
}

std::string RegistrationSession::stateText() const
{
  return part() ? scene::registrationToString(*part()) : std::string();
}

void RegistrationSession::moveByHand(const core::RigidTransform& mrFromCt)
{
  const std::string what = "move of " + shownName(m_name);
  m_model.changeMr([&](scene::Case& value)
                   { scene::applyRegistration(value, m_name, mrFromCt, manualRegistration()); },
                   what, what + '\n' + m_name);
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
  const bool isByHand = part() && part()->registration &&
                        part()->registration->method == Registration::Method::ByHand;
  return isByHand ? difference(m_fitted, part()->mrFromCt, m_model.crosshair()) : MrDifference{};
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

void RegistrationSession::setAim(const RegistrationAim& aim)
{
  m_aim = aim;
  checkAim();
}

void RegistrationSession::checkAim()
{
  const auto has = [](const std::vector<std::string>& names, const std::string& name)
  { return std::find(names.begin(), names.end(), name) != names.end(); };
  if (!has(ontoNames(), m_aim.onto))
    m_aim.onto.clear();
  if (m_aim.place == RegistrationAim::Place::Structure && !has(placeNames(), m_aim.structure))
    m_aim.place = RegistrationAim::Place::MiddleEar;
}

std::vector<std::string> RegistrationSession::ontoNames() const
{
  return part() ? presenters::ontoNames(m_model.value(), m_name) : std::vector<std::string>();
}

std::vector<std::string> RegistrationSession::placeNames() const
{
  return m_model.hasCase() ? presenters::placeNames(m_model.value()) : std::vector<std::string>();
}

namespace
{

// "cochlea" of "cochlea 2" (scene::freeName).
std::string withoutNumber(const std::string& name)
{
  const std::size_t last = name.find_last_not_of("0123456789");
  const bool isNumbered = last != std::string::npos && last + 1 < name.size() && last > 0 &&
                          (name[last] == ' ' || name[last] == '_' || name[last] == '-');
  return isNumbered ? name.substr(0, last) : name;
}

} // namespace

std::vector<PlaceChoice> RegistrationSession::placeChoices() const
{
  std::vector<PlaceChoice> choices;
  std::map<std::string, int> alike;
  for (const std::string& name : placeNames())
  {
    ++alike[withoutNumber(name)];
    PlaceChoice choice{name};
    const scene::Case& value = m_model.value();
    const scene::StructurePart* structure = scene::findStructure(value, name);
    choice.isMesh = !structure;
    choice.volume = structure ? structure->volume : 0.0;
    for (const scene::LabelPart& part : value.labels)
      for (const scene::StructurePart& one : part.structures)
        if (&one == structure)
          choice.drawnOn = scene::placementOf(value, part).drawnOn;
    for (const scene::MeshPart& mesh : value.meshes)
      if (choice.isMesh && mesh.name == name)
        choice.drawnOn = mesh.drawnOn;
    choices.push_back(std::move(choice));
  }
  for (PlaceChoice& choice : choices)
    choice.isAlike = alike.at(withoutNumber(choice.name)) > 1;
  return choices;
}

std::string RegistrationSession::placeNote() const
{
  if (m_aim.place != RegistrationAim::Place::MiddleEar || !part() ||
      !earNames(m_model.value()).empty())
    return {};
  return "the case has no ossicle, tympanic cavity or inner ear on the " + primary() +
         ", so that the error is stated at the centre of the images, which may be far from the "
         "ear; put the crosshair in the middle ear and choose it here, or choose a structure";
}

RegistrationRequest RegistrationSession::request(Way way) const
{
  using From = RegistrationRequest::From;
  RegistrationRequest request;
  request.mr = m_name;
  if (way == Way::Landmarks)
  {
    request.from = From::Landmarks;
    request.asIs = true;
    for (const LandmarkList::Row& row : m_landmarks.rows())
      if (row.mr)
        request.landmarks.push_back({row.ct, *row.mr});
    return request;
  }
  request.onto = m_aim.onto;
  if (m_aim.place == RegistrationAim::Place::Crosshair)
    request.at = placeAt(m_model.value(), m_model.crosshair());
  else if (m_aim.place == RegistrationAim::Place::Structure)
    request.atStructure = m_aim.structure;
  if (m_aim.box > 0.0)
  {
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * m_aim.box);
    request.region = {m_model.crosshair() - half, m_model.crosshair() + half};
  }
  if (way == Way::Refine || m_aim.start == RegistrationAim::Start::Present)
  {
    request.from = From::Given;
    request.given = part()->mrFromCt;
    request.givenBy = part()->registration;
    request.lookAround = way == Way::Register;
  }
  else if (m_aim.start == RegistrationAim::Start::Centres)
    request.from = From::Centres;
  return request;
}

bool RegistrationSession::take(const RegistrationOutcome& outcome)
{
  if (!part() || m_model.drilling() || outcome.failed)
    return false;
  checkLies(outcome.grid, part());
  if (!outcome.onto.empty())
    checkLies(outcome.ontoGrid, scene::findMr(m_model.value(), outcome.onto));
  m_fitted = outcome.mrFromCt;
  m_model.changeMr([&](scene::Case& value) { accept(value, m_name, outcome); },
                   "registration of " + shownName(m_name));
  return true;
}

void RegistrationSession::keep(const core::RigidTransform& best)
{
  if (!part() || m_model.drilling())
    return;
  Registration how;
  how.text = "stopped before its end";
  m_fitted = best;
  m_model.changeMr([&](scene::Case& value) { scene::applyRegistration(value, m_name, best, how); },
                   "registration of " + shownName(m_name));
}

bool RegistrationSession::lies(const core::RigidTransform& mrFromCt) const
{
  return part() && part()->registered && part()->mrFromCt.matrix() == mrFromCt.matrix();
}

void RegistrationSession::unregister()
{
  if (part() && part()->registered)
    m_model.changeMr([this](scene::Case& value) { scene::removeRegistration(value, m_name); },
                     "removal of the registration of " + shownName(m_name));
}

void RegistrationSession::signOff(const std::string& who, const std::string& when)
{
  m_model.changeMr([&](scene::Case& value) { scene::signOff(value, m_name, who, when); });
}

} // namespace petrous::presenters
