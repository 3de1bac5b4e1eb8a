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

/// Where the error of a registration is estimated.
struct RegistrationPlace
{
  Eigen::Vector3d point{0.0, 0.0, 0.0}; ///< CT patient point, LPS mm
  std::string words;                    ///< "the incus", "the centre of what both images show"
};

/// How one MR of a case is to be registered to the CT.
struct RegistrationRequest
{
  enum class From
  {
    Header,    ///< as in the image headers
    Centres,   ///< image centres aligned
    Landmarks, ///< `landmarks`
    Given      ///< `given`
  };
  std::string mr;
  From from = From::Header;
  std::vector<registration::LandmarkPair> landmarks; ///< CT and MR patient points, LPS mm
  core::RigidTransform given;                        ///< X_MC, CT to MR patient points
  /// How `given` was obtained; none: by hand, or by another program.
  std::optional<scene::Registration> givenBy;
  bool lookAround = false;             ///< also search around `given`, as far as from the header
  bool asIs = false;                   ///< no fit: placed by landmarks, user or frame of reference
  std::optional<RegistrationPlace> at; ///< none: see defaultPlace
  std::string atStructure;             ///< or there, if `at` is empty; see placeOf
  std::optional<core::PatientBox> region; ///< CT patient box to fit in; none: everywhere
  std::string onto; ///< another, already registered MR to fit to; empty: the CT
  std::uint32_t seed = 1;
};

struct RegistrationOutcome
{
  /// Whether it is not to be used; the case must then stay unchanged.
  bool failed = false;
  core::RigidTransform mrFromCt; ///< X_MC
  scene::Registration how;       ///< includes the verdict's text, also if it failed
  registration::Fit fit;         ///< to `onto` if given; empty if nothing was fitted
  double estimateSeconds = 0.0;
  /// The MR's grid, and that of `onto`, as they were when they were registered: the result holds
  /// for no others. None: of a result that was not computed.
  std::optional<core::GridGeometry> grid, ontoGrid;
  std::string onto; ///< another MR to which it was registered; empty: the CT
};

/// A structure of the middle or inner ear, by name, or else the centre of the region common to both
/// images before the fit. Loads label maps.
RegistrationPlace defaultPlace(const scene::Case& value, const RegistrationRequest& request);

/// The structures of the middle and inner ear that can be placed on the CT, by their names: those
/// of which defaultPlace takes the first that is not empty. Loads nothing.
std::vector<std::string> earNames(const scene::Case& value);

/// A CT patient point, LPS mm; described by its coordinates. Throws InvalidParameter outside the
/// CT.
RegistrationPlace placeAt(const scene::Case& value, const Eigen::Vector3d& point);

/// The centroid of a structure or mesh. Throws InvalidParameter if there is none of that name, or
/// it cannot be placed on the CT.
RegistrationPlace placeOf(const scene::Case& value, const std::string& structure);

/// Structures and meshes that can be placed on the CT: valid arguments of placeOf.
std::vector<std::string> placeNames(const scene::Case& value);

/// The MRs to which `mr` can be registered: registered themselves, and not through `mr`.
std::vector<std::string> ontoNames(const scene::Case& value, const std::string& mr);

/// Error of X_CB X_BA at the point of the second, X_CB, whose error is stated in frame A as well
/// (CT space); both are independent. That of the first, X_BA, is taken there by its spread if it
/// has one, else as it was stated at its own point. It has a spread if both have one.
scene::RegistrationError chained(const scene::RegistrationError& second,
                                 const scene::RegistrationError& first,
                                 const core::RigidTransform& bFromA);

/// Registers the MR; the case is not modified. Loads the two images.
///
/// To another MR, the fit starts at the identity if both share a frame of reference (unless
/// landmarks or a transform are given), and the frame of reference is compared with the fit. The
/// error is that of both registrations combined.
///
/// The listener's poses are X_MC. Throws InvalidParameter for an invalid request, CancelledError.
RegistrationOutcome registerMr(const scene::Case& value, const RegistrationRequest& request,
                               const core::Progress& progress = {},
                               const registration::MetricListener& listener = {});

/// Applies the registration to the MR (scene::applyRegistration); no effect if it failed.
void accept(scene::Case& value, const std::string& mr, const RegistrationOutcome& outcome);

} // namespace petrous::presenters
