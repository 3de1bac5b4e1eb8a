#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Registration/Landmarks.h"
#include "petrous/Registration/Register.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// Where the error of a registration is stated.
struct RegistrationPlace
{
  Eigen::Vector3d point{0.0, 0.0, 0.0}; ///< CT patient point, LPS mm
  std::string words;                    ///< "the incus", "the centre of what both images show"
};

/// How one MR of a case is to be laid on the CT.
struct RegistrationRequest
{
  enum class From
  {
    Header,    ///< as the files say
    Centres,   ///< the images' middles on each other
    Landmarks, ///< `landmarks`
    Given      ///< `given`
  };
  std::string mr;
  From from = From::Header;
  std::vector<registration::LandmarkPair> landmarks; ///< CT and MR patient points, LPS mm
  core::RigidTransform given;                        ///< X_MC, CT to MR patient points
  /// How the MR came to lie at `given`; none: a hand put it there, or another program.
  std::optional<scene::Registration> givenBy;
  bool lookAround = false; ///< about `given`, too, as far as from the header
  bool asIs = false;       ///< without a fit: where the landmarks, the hand or the frame put it
  std::optional<RegistrationPlace> at;    ///< none: see defaultPlace
  std::string atStructure;                ///< or there, without `at`; see placeOf
  std::optional<core::PatientBox> region; ///< CT patient box that counts; none: all
  std::string onto; ///< another MR, already registered: the fit is to that; empty: to the CT
  std::uint32_t seed = 1;
};

struct RegistrationOutcome
{
  /// Whether it is not to be used; nothing is to change in the case then.
  bool failed = false;
  core::RigidTransform mrFromCt; ///< X_MC
  scene::Registration how;       ///< with the verdict's text also where it failed
  registration::Fit fit;         ///< to `onto` where there is one; empty where nothing was fitted
  double estimateSeconds = 0.0;
};

/// A structure of the middle or inner ear by its name, or else the centre of what both images show
/// before the fit. Loads label maps.
RegistrationPlace defaultPlace(const scene::Case& value, const RegistrationRequest& request);

/// A CT patient point, LPS mm; its words are its coordinates. Throws InvalidParameter outside the
/// CT.
RegistrationPlace placeAt(const scene::Case& value, const Eigen::Vector3d& point);

/// The middle of a structure or mesh. Throws InvalidParameter where there is none of that name, or
/// it has no place on the CT.
RegistrationPlace placeOf(const scene::Case& value, const std::string& structure);

/// Structures and meshes that have a place on the CT: what placeOf takes.
std::vector<std::string> placeNames(const scene::Case& value);

/// The MRs onto which that one can be registered: they lie on the CT, and not through it.
std::vector<std::string> ontoNames(const scene::Case& value, const std::string& mr);

/// Does the work; the case stays as it is. Loads the two images.
///
/// Onto another MR, the fit begins at the identity where both have one frame of reference in common
/// (unless landmarks or a transform are given), and what that frame says is compared with what the
/// fit says. The error is that of both ways together.
///
/// The listener's poses are X_MC. Throws InvalidParameter for a request that cannot be done,
/// CancelledError.
RegistrationOutcome registerMr(const scene::Case& value, const RegistrationRequest& request,
                               const core::Progress& progress = {},
                               const registration::MetricListener& listener = {});

/// Lays the MR on the CT as registered (scene::layMr); nothing where that failed.
void accept(scene::Case& value, const std::string& mr, const RegistrationOutcome& outcome);

} // namespace petrous::presenters
