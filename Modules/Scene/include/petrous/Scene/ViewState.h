#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Lazy.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Dissection/Stroke.h"

namespace petrous::scene
{

// Outside of ViewState, since a class whose members have initial values is default constructible
// only where the class around it is complete: std::optional<Slices>::emplace() (CWG 1397).

/// A plane of the slices, whose picture is centred on the crosshair and shows the whole slice at 1.
struct SlicePlane
{
  double zoom = 1.0;                     ///< at least 1
  Eigen::Vector3d offset{0.0, 0.0, 0.0}; ///< of the picture's centre, patient LPS mm
};

/// Planes that are not the standard ones; patient LPS.
struct TurnedPlanes
{
  /// Of length 1, perpendicular to each other.
  struct Axes
  {
    Eigen::Vector3d right{1.0, 0.0, 0.0}; ///< along the picture's rows
    Eigen::Vector3d down{0.0, 1.0, 0.0};  ///< along its columns
  };
  std::string kind; ///< "petrous", "free", or "tool-axial", ... by the one across the tool
  std::array<Axes, 3> planes; ///< in place of axial, coronal, sagittal
};

/// What the slices showed.
struct SlicesView
{
  using Plane = SlicePlane;
  using Turned = TurnedPlanes;
  /// An MR over the CT.
  struct Overlay
  {
    std::string mr;       ///< of the case
    std::string mode;     ///< "blend", "edges" or "checker"
    double opacity = 0.5; ///< of the MR in a blend, 0 to 1
  };
  /// What a slice shows of the layer around it.
  struct Slab
  {
    double thickness = 0.0; ///< mm; above 0
    std::string projection; ///< "mip", "minip" or "mean"
  };
  Eigen::Vector3d crosshair{0.0, 0.0, 0.0}; ///< patient LPS mm
  double width = 0.0;                       ///< of the grey window, in the CT's unit; above 0
  double level = 0.0;
  std::optional<std::array<Plane, 3>> planes = {}; ///< axial, coronal, sagittal
  std::optional<Overlay> overlay = {};
  std::optional<Turned> turned = {};
  std::optional<Slab> slab = {};
};

struct LightView
{
  double falloff = 0.0;      ///< mm from the lamp to half its intensity; 0: none
  double wetness = 0.0;      ///< 0 to 1
  bool shadows = false;      ///< ambient occlusion, and the lamp's shadow
  double exposure = 0.0;     ///< EV, -kMaxExposure to kMaxExposure
  bool toneCurve = false;    ///< highlights roll off instead of being clipped
  double edges = 0.0;        ///< opacity of translucent surfaces from the side, 0 to 1
  double grain = 0.0;        ///< contrast of the grain of cut bone, 0 to 1
  bool exitSurfaces = false; ///< translucent tissue is shaded also where a ray leaves it
  static constexpr double kMaxExposure = 4.0;
};

struct StereoView
{
  std::string mode = "none"; ///< or "side-by-side", "interleaved", "anaglyph", "quad-buffer"
  std::optional<double> eyeSeparation; ///< mm; nullopt: by the microscope's usual angle
  std::optional<double> convergence;   ///< mm from the camera; nullopt: the focal point
};

/// How the mouse's handpiece lies on the screen.
struct HandpieceView
{
  double turn = 0.0;   ///< degrees from right (0) to up (90), -180 to 180
  double tilt = 0.0;   ///< degrees from the line of sight, 0 to 90
  bool isLeft = false; ///< in the left hand; for the other one it is mirrored
};

struct ToolView
{
  dissection::Burr burr;
  double thrust = 1.0;  ///< N, of a device without force
  bool byWheel = false; ///< the wheel moves the burr in depth
};

/// An instrument of the user's that was used with the case: a closed mesh that is felt and removes
/// nothing.
struct InstrumentView
{
  static constexpr std::size_t kLongestName = 100; ///< bytes

  std::string name;                    ///< as its file is called; it does not leave: then empty
  std::string object;                  ///< of its surface in the library; empty: not stored yet
  std::string axis = "z+";             ///< of the surface, from its tip to the hand
  core::Lazy<core::TriangleMesh> mesh; ///< mm, in the coordinates of its file
};

/// How a case was looked at when it was saved, besides its camera, and the tool that was set. What
/// is absent is as the program that shows the case has it.
struct ViewState
{
  static constexpr std::size_t kMaxClippingPlanes = 6;

  using Slices = SlicesView;
  using Light = LightView;
  using Stereo = StereoView;
  using Handpiece = HandpieceView;
  using Tool = ToolView;
  using Instrument = InstrumentView;

  /// What is cut away from the picture, not from the bone.
  struct Clipping
  {
    struct Plane
    {
      Eigen::Vector3d point{0.0, 0.0, 0.0};  ///< patient LPS mm
      Eigen::Vector3d normal{0.0, 0.0, 1.0}; ///< of length 1; to the side that stays
    };
    std::vector<Plane> planes;          ///< at most kMaxClippingPlanes
    std::optional<core::IndexBox> crop; ///< voxels of the CT that are shown; not empty
    bool empty() const { return planes.empty() && !crop; }
  };

  /// A view that is kept beside the present one: that the user named, or that a branch was left
  /// with. What is absent stays as it is where the view is shown.
  struct Saved
  {
    std::optional<core::CameraPose> camera; ///< one that the user named has it
    std::optional<Slices> slices;           ///< without an MR over them
    /// Of a branch; an empty one cuts nothing away. One that the user named has none.
    std::optional<Clipping> clipping;
  };
  static constexpr std::size_t kMaxSaved = 100;
  static constexpr std::size_t kLongestName = 100; ///< of a saved view, bytes

  std::map<std::string, Saved> saved; ///< by name

  /// Of the branches other than the current one, by name, as they were left; of those left in older
  /// programs the camera alone. Names of no branch are not saved.
  std::map<std::string, Saved> branches;
  std::optional<Slices> slices;
  std::optional<Light> light;
  std::optional<Stereo> stereo;
  Clipping clipping;
  std::optional<Tool> tool;
  std::optional<Handpiece> handpiece; ///< as at first
  std::optional<Instrument> instrument;
};

bool operator==(const ViewState::Slices& a, const ViewState::Slices& b);
bool operator==(const ViewState::Light& a, const ViewState::Light& b);
bool operator==(const ViewState::Stereo& a, const ViewState::Stereo& b);
bool operator==(const ViewState::Clipping& a, const ViewState::Clipping& b);
bool operator==(const ViewState::Handpiece& a, const ViewState::Handpiece& b);
bool operator==(const ViewState::Tool& a, const ViewState::Tool& b);
/// Of the same object, or the same mesh in memory.
bool operator==(const ViewState::Instrument& a, const ViewState::Instrument& b);

/// Throws InvalidParameter unless it is valid for a saved view: 1 to kLongestName bytes of UTF-8
/// without characters that are not seen and without spaces around it.
void checkViewName(const std::string& name);

/// Throws InvalidParameter naming the first value that is out of its range.
void checkView(const ViewState& view);

} // namespace petrous::scene
