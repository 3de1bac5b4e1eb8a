#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "petrous/Core/RigidTransform.h"

namespace petrous::scene
{

/// How well an MR lies on the CT at one place: the length of the vector between where a point of
/// the CT is in the MR and where the registration puts it.
struct RegistrationError
{
  Eigen::Vector3d point{0.0, 0.0, 0.0}; ///< CT patient point, LPS mm
  std::string place;                    ///< what is there, in words: "incus"
  double median = 0.0;                  ///< mm
  double p95 = 0.0;                     ///< mm
  double max = 0.0;                     ///< mm
};

/// That a surgeon looked at a registration and accepts it. It holds for one transform only.
struct SignOff
{
  std::string who;                ///< a clinician's name, never a patient's
  std::string when;               ///< ISO 8601, UTC
  core::RigidTransform transform; ///< what was signed: ImagePart::mrFromCt as it was then
};

/// How an MR came to lie on the CT.
struct Registration
{
  enum class Method
  {
    MutualInformation,
    Landmarks,       ///< pairs of points
    ByHand,          ///< moved by the user, or a transform from elsewhere
    FrameOfReference ///< the scanner's own, which it has in common with another image
  };
  enum class Verdict
  {
    NotJudged,
    Good,
    Doubtful
  };

  Method method = Method::MutualInformation;
  bool refined = false; ///< by mutual information, from where the method put it
  Verdict verdict = Verdict::NotJudged;
  std::string text;             ///< the verdict's reason, in words
  std::optional<double> metric; ///< mutual information, nats
  std::optional<RegistrationError> error;
  std::string through; ///< the MR on which it was laid, whose own way to the CT was known; or empty
  std::optional<SignOff> signOff;
};

const char* nameOf(Registration::Method method) noexcept;   ///< as in manifest and JSON
const char* nameOf(Registration::Verdict verdict) noexcept; ///< "good", "doubtful", "not judged"

/// Throw InvalidParameter for a name that is none of these.
Registration::Method methodFromName(const std::string& name);
Registration::Verdict verdictFromName(const std::string& name);

/// What follows "by": "hand", "mutual information", "landmarks, refined by mutual information,
/// through 'T2'".
std::string methodInWords(const Registration& registration);

} // namespace petrous::scene
