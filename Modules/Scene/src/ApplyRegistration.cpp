#include "petrous/Scene/ApplyRegistration.h"

#include <algorithm>
#include <utility>

#include "petrous/Core/NumberText.h"

namespace petrous::scene
{

namespace
{

ImagePart& mrNamed(Case& value, const std::string& name)
{
  const auto found = std::find_if(value.mr.begin(), value.mr.end(),
                                  [&name](const ImagePart& mr) { return mr.name == name; });
  if (found != value.mr.end())
    return *found;
  std::string there;
  for (const ImagePart& mr : value.mr)
    there += (there.empty() ? "" : ", ") + mr.name;
  throw core::InvalidParameter("case '" + value.name + "' has no MR '" + name + "'; " +
                               (there.empty() ? "it has none" : "it has " + there));
}

bool came(const ImagePart& mr, const std::string& through)
{
  return mr.registered && mr.registration && mr.registration->through == through &&
         mr.name != through;
}

bool same(const core::RigidTransform& a, const core::RigidTransform& b)
{
  return a.rotation().coeffs() == b.rotation().coeffs() && a.translation() == b.translation();
}

// Discards the voxels of meshes drawn on the MR, which are at its old position.
void forgetVoxels(Case& value, const std::string& mr)
{
  for (MeshPart& mesh : value.meshes)
    if (mesh.drawnOn == mr)
      mesh.touch = {};
}

// Rejects a transform in another unit, or without its decimal point, which would leave the images
// without overlap; numbers beyond float range would corrupt everything computed from them.
void checkMeets(const core::GridGeometry& ct, const ImagePart& mr,
                const core::RigidTransform& mrFromCt)
{
  constexpr double kMin = 500.0; // mm
  const core::PatientBox ctBox = ct.patientBounds();
  const core::PatientBox box = mr.geometry.patientBounds();
  const double most =
      std::max(kMin, (ctBox.max() - ctBox.min()).norm() + (box.max() - box.min()).norm());
  const Eigen::Vector3d at = mrFromCt * ct.center();
  const double apart = (at.cwiseMax(box.min()).cwiseMin(box.max()) - at).norm();
  if (apart <= most)
    return;
  throw core::InvalidParameter(
      "MR '" + mr.name + "' cannot be registered so: the CT's middle would lie " +
      core::fixedText(apart, 0) + " mm outside it, and at most " + core::fixedText(most, 0) +
      " mm are taken; check unit and decimal point of the transform");
}

void lay(Case& value, const std::string& name, const core::RigidTransform& mrFromCt,
         Registration how);

} // namespace

bool liesThrough(const Case& value, const std::string& name, const std::string& through)
{
  std::string next = name;
  for (std::size_t n = 0; n <= value.mr.size() && !next.empty(); ++n)
  {
    if (next == through)
      return true;
    const ImagePart* mr = findMr(value, next);
    next = mr && mr->registration ? mr->registration->through : std::string();
  }
  return false;
}

void checkThrough(const Case& value, const std::string& name, const std::string& through)
{
  if (liesThrough(value, through, name))
    throw core::InvalidParameter("MR '" + name + "' cannot lie on the CT through '" + through +
                                 "', which lies there through '" + name + "'");
}

void applyRegistration(Case& value, const std::string& name, const core::RigidTransform& mrFromCt,
                       Registration how)
{
  checkThrough(value, name, how.through);
  checkMeets(value.ct.geometry, mrNamed(value, name), mrFromCt);
  lay(value, name, mrFromCt, std::move(how));
}

namespace
{

void lay(Case& value, const std::string& name, const core::RigidTransform& mrFromCt,
         Registration how)
{
  ImagePart& mr = mrNamed(value, name);
  how.signOff.reset();
  const bool hadPlace = mr.registered;
  const core::RigidTransform before = mr.mrFromCt;
  mr.mrFromCt = mrFromCt;
  mr.registered = true;
  mr.registration = std::move(how);
  forgetVoxels(value, name);
  if (!hadPlace || same(before, mrFromCt))
    return;
  for (ImagePart& other : value.mr)
  {
    if (!came(other, name))
      continue;
    Registration along = *other.registration;
    along.verdict = Registration::Verdict::NotJudged;
    along.text = "moved along with '" + name +
                 "', which was registered again; register it again "
                 "to know its error";
    along.error.reset();
    along.metric.reset();
    lay(value, other.name, other.mrFromCt * before.inverse() * mrFromCt, std::move(along));
  }
}

} // namespace

void removeRegistration(Case& value, const std::string& name)
{
  ImagePart& mr = mrNamed(value, name);
  mr.mrFromCt = {};
  mr.registered = false;
  mr.registration.reset();
  forgetVoxels(value, name);
  for (const ImagePart& other : value.mr)
    if (came(other, name))
      removeRegistration(value, other.name);
}

void signOff(Case& value, const std::string& name, const std::string& who, const std::string& when)
{
  ImagePart& mr = mrNamed(value, name);
  if (!mr.registered || !mr.registration)
    throw core::InvalidParameter("MR '" + name + "' is not registered: there is nothing to sign");
  checkPersonName(who);
  mr.registration->signOff = SignOff{who, when, mr.mrFromCt};
}

const SignOff* validSignOff(const ImagePart& mr) noexcept
{
  if (!mr.registered || !mr.registration || !mr.registration->signOff)
    return nullptr;
  const SignOff& signOff = *mr.registration->signOff;
  return same(signOff.transform, mr.mrFromCt) ? &signOff : nullptr;
}

std::string registrationToString(const ImagePart& mr)
{
  if (!mr.registered)
    return "not registered";
  if (!mr.registration)
    return "registered, not said how";
  const Registration& how = *mr.registration;
  std::string words = "registered by " + methodToString(how) + ", " + nameOf(how.verdict);
  if (how.error)
    words += ", error " + core::fixedText(how.error->p95, 2) + " mm (p95) at " + how.error->place;
  else
    words += ", its error unknown";
  if (const SignOff* signOff = validSignOff(mr))
    words += signOff->who.empty()
                 ? std::string(", signed off; who and when stayed where it came from")
                 : ", signed off by " + signOff->who + " on " + signOff->when;
  else
    words += ", not signed off";
  return words;
}

} // namespace petrous::scene
