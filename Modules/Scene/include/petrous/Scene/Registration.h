#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "petrous/Core/RigidSpread.h"
#include "petrous/Core/RigidTransform.h"

namespace petrous::scene
{

/// Target registration error at one point: distance between the true position of a CT point in the
/// MR and where the registration maps it. With a spread also that at any other point.
struct RegistrationError
{
  Eigen::Vector3d point{0.0, 0.0, 0.0}; ///< CT patient point, LPS mm
  std::string place;                    ///< anatomical description: "incus"
  double median = 0.0;                  ///< mm
  double p95 = 0.0;                     ///< mm
  double max = 0.0;                     ///< mm
  /// Of mrFromCt, in CT space; none: from an older program, or no rigid motion describes the error.
  std::optional<core::RigidSpread> spread = {};
};

/// A surgeon's acceptance of a registration after inspection. Valid for one transform only.
struct SignOff
{
  std::string who;  ///< a clinician's name, never a patient's; empty: not told with the case
  std::string when; ///< ISO 8601, UTC; likewise
  core::RigidTransform transform; ///< the accepted ImagePart::mrFromCt
};

/// How an MR was registered to the CT.
struct Registration
{
  enum class Method
  {
    MutualInformation,
    Landmarks,       ///< pairs of points
    ByHand,          ///< moved by the user, or an external transform
    FrameOfReference ///< shared with another image according to the scanner
  };
  enum class Verdict
  {
    NotJudged,
    Good,
    Doubtful
  };

  Method method = Method::MutualInformation;
  bool isFromFile = false; ///< ByHand: of a file's transform, not moved by the user
  bool refined = false;    ///< by mutual information, from the result of the method
  Verdict verdict = Verdict::NotJudged;
  std::string text;             ///< reason for the verdict, for the user
  std::optional<double> metric; ///< mutual information, nats
  std::optional<RegistrationError> error;
  std::string through; ///< the registered MR to which it was aligned; or empty
  std::optional<SignOff> signOff;
};

const char* nameOf(Registration::Method method) noexcept;   ///< as in manifest and JSON
const char* nameOf(Registration::Verdict verdict) noexcept; ///< "good", "doubtful", "not judged"

/// Throw InvalidParameter for an unknown name.
Registration::Method methodFromName(const std::string& name);
Registration::Verdict verdictFromName(const std::string& name);

/// Phrase following "by": "hand", "mutual information", "landmarks, refined by mutual information,
/// through 'T2'".
std::string methodToString(const Registration& registration);

} // namespace petrous::scene
