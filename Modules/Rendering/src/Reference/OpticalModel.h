#pragma once

#include <Eigen/Core>

#include "petrous/Appearance/Material.h"
#include "petrous/Core/CameraPose.h"
#include "petrous/Core/GridGeometry.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering
{

/// The optical model of a ray, shared by the GPU renderer (shaders/RayCast.frag.glsl) and the
/// reference (ReferenceRayCaster), after [Chan2013, 2.2] and [Chan2016, "Visual rendering"].
///
/// At a point x the ray is in one of these states; f is the tissue field of the scene:
///   air              f <= 0, or outside the hull of the CT's voxel centres, of those in the crop
///                    box or of a clipping plane; a hull of zero thickness is air
///   soft tissue      f <= 0 inside all of these, where max(c_CT, c_L) <= 0, also where the CT is
///                    not drawn, and nothing is cut away (mask > 0.5), if SceneContents::softTissue
///                    has any opacity; else air, too
///   bone             f > 0 and occupancy <= 0.5
///   structure i      f > 0 and occupancy > 0.5, i = volume::structureAt(x): the label index of the
///                    voxel nearest to x and, where two structures meet, the one with the greatest
///                    weight among the eight voxels around x (Volume/LabelBorders.h)
/// There is a surface where the state changes from air or soft tissue to bone or a structure, or
/// from anything to a structure; with LightSettings::exitSurfaces (record 85) also where it changes
/// from bone or a structure to air or soft tissue, but not where the drawn region ends. All other
/// changes only change the material. A surface adds its lit
/// colour weighted by the material's surface opacity; inside tissue the colour and extinction of
/// the material's transfer function are integrated:
///   C = sum_surfaces T a_s c_s + integral T sigma(v) c(v) l ds,  T the transmittance so far
/// A ray ends at opaque polygons; the remaining T weights what is behind. Lit colours have no upper
/// bound in C; what is displayed of them is displayed(C, their weights' sum). Colours that are not
/// lit, or compared with a legend, are added to that as they are.
///
/// Inside tissue no normal is computed, but in soft tissue, whose own surfaces (skin, fat on
/// muscle) are such changes of intensity: its cosine is softFacing, with the gradient of what it
/// reads by central differences over +-1 voxel of the CT's grid.
///
/// Surface at x, unit normal n (out of the tissue), from -grad of the deciding operand (c_CT,
/// occupancy or mask), by central differences over +-1 voxel of its grid; for bone -> structure
/// that of occupancy; for structure -> structure i that of the depth in i (without borders: of the
/// fraction that belongs to i), from the 27 voxels around x with quadratic B-spline weights; c_CT
/// by edgeGradientInPatient if the material's surface opacity is at least kSmoothOpacity:
///   v       intensity at x - n * kColorDepth * (smallest spacing of the CT), clamped to the hull
///           of the sampled image
///   c_s     surfaceColor(transfer(v), |n . ray|, distance along the ray)
///   opacity edgeOpacity(material.surfaceOpacity, c), c = |n . ray|, of c_CT's surfaces
///           edgeFacing(|n . ray|, the size of the gradient that gave n)
/// Of a picture that is the mean of several samples a pixel, c_s of c_CT's surfaces that
/// edgeGradientInPatient shades has asideFacing in place of |n . ray|, with the gradient at x and
/// the same at x + asideOf(sample), clamped to the hull. All else is of n.
/// The material is i's from structure to structure i; otherwise structureAt(x)'s where occupancy >
/// 0.5 - 1e-3 at x; otherwise a lumen's where the index at x is that of a lumen; otherwise bone.
/// Where tissue is cut off by the hull, the crop box or a clipping plane, n is that face's normal
/// and v is taken at x itself; with SceneContents::section its colour is sectionGrey of the CT's
/// value if the material is bone's, otherwise transfer(v), and neither is lit. With a
/// section soft tissue, too, has a surface where the crop box or a clipping plane, but not the
/// hull, cuts it off and its extinction is above kSoftInSection: opaque, not lit, of sectionGrey of
/// the CT's value, or of transfer(v) if it reads another image. A zero gradient (n = 0) faces the
/// camera, as does tissue that contains the camera. Depth is that of the first surface, whatever
/// its opacity.
///
/// Grain (LightSettings::grain; record 80): where a surface that is not such a face has the
/// material of bone or of a lumen and the mask decides, the transfer function's colour c becomes
/// min(c grainFactor, 1).
///
/// Thickness over a structure: if a surface that is not such a face has the material of bone or of
/// a lumen, and the distance d to the structure there (trilinear, ThicknessOverlay) is below
/// `farthest`, thicknessColor(d / farthest) replaces the transfer function's colour; light and
/// highlight stay.
///
/// Shadows (LightSettings::shadows; records 33 and 42): a surface that a ray in air or soft tissue
/// meets, and that is not such a face, and one of a mesh or of the tool, with the normal n towards
/// the camera, sees (soft tissue stops nothing)
///   sky     1 - 1/pi integral over the hemisphere of n of (n . w) b(w) (1 - (d / r)^2) dw
///   lamp    1 - mean over the lamp's disc of b(w)
/// where b(w) is the fraction that tissue, closed meshes and the tool stop of what comes from
/// direction w, and d the distance at which they do, up to r = kOcclusionReach; for the lamp up to
/// where it stands, at most kShadowReach (record 77). A surface that a ray in air enters stops the
/// opacity of its material, a mesh its own opacity where it is entered (of a drilled one, what the
/// mask left), both only in the hull, the crop box and on the drawn side of clipping planes; the
/// tool (ToolShape.h, or the instrument) stops all, but nothing of what reaches itself. What a mesh
/// or the tool lies in stops nothing of it. All other surfaces see all.
namespace optics
{

/// Depth below the surface, in smallest spacings, at which the intensity that colours it is
/// sampled. Closer to the surface, partial volume with air produces voxel contour lines on smooth
/// bone.
constexpr double kColorDepth = 2.0;

/// Effective cosine for all directions inside a scattering tissue (no normal is computed there).
constexpr double kInteriorFacing = 2.0 / 3.0;

/// Exponent of the highlight of a film of water: half of it is seen 4.4 degrees off.
constexpr double kWetShininess = 240.0;

constexpr double kOccupancyThreshold = 0.5 - 1e-3;

/// Surface opacity from which slice steps are smoothed when shading the CT's surface. They are less
/// visible on more transparent surfaces, and a ray meets many of those.
constexpr double kSmoothOpacity = 0.5;

/// Voxels by which a sample's light is taken aside, along each axis: a pair at +-0.75 cancels what
/// repeats from voxel to voxel. On a CT whose smallest spacing is at most kFineSpacing (mm), which
/// samples borders well, it is none; from kCoarseSpacing on it is all.
constexpr double kAside = 0.75;
constexpr double kFineSpacing = 0.3;
constexpr double kCoarseSpacing = 0.7;

/// Cosine of the angle between the normals at a surface and aside of it up to which the latter is
/// of something else (the other side of a thin plate, an edge), and from which it counts in full.
constexpr double kUnlike = 0.6;
constexpr double kAlike = 0.9;

/// Size of a gradient aside, relative to that at the surface, which counts as one, about the mean
/// of the four corners; and the most that one counts. So weighted, the mean of the samples' cosines
/// is nearly that of the sum of the gradients, in which small ones, which noise turns, say little.
constexpr double kAsideSlope = 0.8;
constexpr double kMostAside = 2.0;

/// Smallest cosine of edgeOpacity: 83 degrees.
constexpr double kLeastFacing = 1.0 / 8.0;

/// Slope of the CT, intensity per mm, at which edgeFacing is half of what the normal says. Borders
/// of cortical bone rise by 300 and more, noise about the iso value (diploe) by less than 150.
constexpr double kEdgeSlope = 150.0;

/// Of the two octaves of the grain of cut bone: edge of their cells, mm; their shares of the noise;
/// by how much it changes the colour at most; and the cells a pixel covers up to which an octave is
/// drawn in full, and from which it is not drawn, so that it does not flicker.
constexpr double kGrainCells[] = {0.35, 0.2};
constexpr double kGrainShares[] = {0.625, 0.375};
constexpr double kGrainContrast = 0.3;
constexpr double kFineGrain = 1.0 / 3.0;
constexpr double kCoarseGrain = 2.0 / 3.0;

/// Distance, mm, up to which tissue keeps the light of the sky from a surface, and that of the
/// lamp.
constexpr double kOcclusionReach = 12.0;
constexpr double kShadowReach = 25.0;

/// Tangents of the angle between the lamp and the view axis, towards the picture's upper edge (8
/// degrees), and of the angular radius of its disc.
constexpr double kLampTilt = 0.14054083;
constexpr double kLampTangent = 0.1;

/// Distance, mm, to the focal point: up to kEndoscopeFocus the lamp is on the axis, as at the tip
/// of an endoscope, and from kMicroscopeFocus on at kLampTilt; the tangent is linear in between.
constexpr double kEndoscopeFocus = 5.0;
constexpr double kMicroscopeFocus = 30.0;

/// Fractions that reach a surface: of the light from all around, and of the lamp's.
struct Seen
{
  double sky = 1.0;
  double lamp = 1.0;
};

/// The lamp of a frame or of both eyes; that of shadows is beside their camera.
struct Lamp
{
  Eigen::Vector3d at{0.0, 0.0, 0.0}; ///< mm; `isFar`: unit vector towards it
  bool isFar = false;
  Eigen::Vector3d up{0.0, 0.0, 1.0}; ///< unit, of the picture
  Eigen::Vector3d right{1.0, 0.0, 0.0};
  double focus = 0.0; ///< mm from the camera to the focal point

  Eigen::Vector3d from(const Eigen::Vector3d& point) const; ///< unit, towards it

  /// How far from a point light is stopped on the way to it, mm: up to the lamp, at most
  /// kShadowReach.
  double reach(const Eigen::Vector3d& point) const;
};
/// At the camera's distance from the focal point; of a parallel projection, far away.
Lamp lampOf(const core::CameraPose& camera);

/// What an exposure, EV, multiplies colours by: 2^(EV / 2.2). Light is calculated with colours as
/// they are displayed, which are about the power 1/2.2 of luminance.
double exposureFactor(double exposure);

/// Light arriving at a distance (mm) from the light source at the camera, d, with e =
/// exposureFactor: intensity e (1 + (focus / falloff)^2) / (1 + (d / falloff)^2), or intensity e if
/// falloff is 0. `focus`: mm to where the falloff changes nothing.
double lightAt(const LightSettings& light, double distance, double focus = 0.0);

/// Of the largest channel, up to which toneCurve changes nothing, and how strongly what it
/// compresses loses its saturation.
constexpr double kToneStart = 0.8;
constexpr double kToneDesaturation = 0.15;

/// Khronos PBR Neutral tone mapper (specification of 2024) without its toe, which is meant for
/// Fresnel reflection. For a largest channel p > s = kToneStart, with d = 1 - s:
///   p' = 1 - d^2 / (p - s + d);  w = 1 / (kToneDesaturation (p - p') + 1)
///   c' = w c p' / p + (1 - w) p'
/// Hue stays; channels are continuously differentiable, rise with the light, and stay below 1.
/// Negative ones count as 0.
Eigen::Vector3d toneCurve(const Eigen::Vector3d& color);

/// A lit colour as it is displayed: by toneCurve if the light has one, else clamped to 0..1.
Eigen::Vector3d displayed(const Eigen::Vector3d& color, const LightSettings& light);

/// Of a pixel, of which lit surfaces and tissues have the part `share`, and together the light
/// `color`: their mean colour as it is displayed, times `share`. What they add and what they let
/// through remain 1 together.
Eigen::Vector3d displayed(const Eigen::Vector3d& color, double share, const LightSettings& light);

/// Opacity of a translucent surface, `opacity` head-on, at a cosine c: that of a shell of constant
/// thickness by the law of Beer and Lambert, through which the path is 1/c times as long (Kay and
/// Greenberg, Transparency for computer synthesized images, 1979):
///   1 - (1 - opacity)^(1 + edges (1 / max(c, kLeastFacing) - 1))
/// What it adds and what it lets through remain 1 together. Faces, and what a surface stops of the
/// light of others (shadows), have `opacity`.
double edgeOpacity(double opacity, double cosine, double edges);

/// Cosine for edgeOpacity of a surface of the CT with a gradient of size `slope`, intensity per mm:
/// 1 + w (|cosine| - 1) with w = slope^2 / (slope^2 + kEdgeSlope^2). Where the CT hardly changes,
/// its normal is that of the noise, and one surface in a few hundred is seen from the side
/// anywhere.
double edgeFacing(double cosine, double slope);

/// Value noise, -1 to 1 with mean 0: a random number for each corner of a cell, blended by the
/// smoothstep of `at`, in cells. The number is that of the corner's indices (i, j, k):
/// i 73856093 xor j 19349663 xor k 83492791 modulo 2^32 (Teschner et al., Optimized spatial hashing
/// for collision detection of deformable objects, 2003) after the finalizer of MurmurHash3, of
/// which the upper 24 bits count.
double grainNoise(const Eigen::Vector3d& at);

/// Cells of an octave of the grain (0, 1) from voxels of the CT: millimetres along the CT's axes
/// from its first voxel, turned by the rotation of the quaternion (9, 4, 2, 5) and (7, -3, 6, 1)
/// over kGrainCells. No anatomical view looks along a turned lattice, so that none is seen.
Eigen::Matrix3d grainFromVoxel(const core::GridGeometry& grid, int octave);

/// Factor of the colour of bone that is cut at a point `voxel` of the CT and seen at a cosine:
///   1 + grain kGrainContrast sum over octaves of
///     kGrainShares (1 - smoothstep(kFineGrain, kCoarseGrain, q)) grainNoise(grainFromVoxel voxel)
/// with q = pixel / (kGrainCells max(|cosine|, kLeastFacing)) the cells that a pixel covers.
/// `pixel`: its edge there, mm.
double grainFactor(const core::GridGeometry& grid, const Eigen::Vector3d& voxel, double cosine,
                   double pixel, double grain);

/// How far aside, in voxels of the CT, the sample of that number (sampleCorner) takes its light;
/// zero if negative.
Eigen::Vector3d asideOf(const core::GridGeometry& grid, int sample);

/// Cosine of the light on a surface: f + w s (g - f), clamped to 0 to 1; f = |here . ray| / |here|,
/// g = |aside . ray| / |aside|, w the smoothstep from kUnlike to kAlike of the cosine between the
/// two gradients, s = min(|aside| / (kAsideSlope |here|), kMostAside).
double asideFacing(const Eigen::Vector3d& here, const Eigen::Vector3d& aside,
                   const Eigen::Vector3d& ray);

/// Grey of a CT's value in a section, 0 to 1.
double sectionGrey(const SectionWindow& window, double value);

/// With the gloss g = k_s specular, k_s of the transfer function:
///   light (c (ambient sky + max(1 - ambient - g facing^2, 0) facing lamp)
///          + lamp ((1 - wetness) g facing^shininess + wetness facing^kWetShininess))
/// without an upper bound. What is reflected as gloss is taken from the lamp's diffuse light, so
/// that a dry surface which faces the lamp, c (1 - g) + g, is at most white; not seen from the
/// side, so that what is dark stays as it is. Below water a surface has no gloss of its own: bone
/// (refractive index 1.55) reflects 4.7 % in air and 0.6 % in water (Fresnel).
///
/// `isScale`: a colour that is compared with a legend; its gloss takes nothing, the light is at
/// most the intensity, and it is displayed as it is, 0..1.
Eigen::Vector3d surfaceColor(const appearance::TransferFunction::Optics& optics, double shininess,
                             double cosine, const LightSettings& light, double distance,
                             const Seen& seen = {}, double focus = 0.0, bool isScale = false);

/// light c (ambient + (1 - ambient) facing), without an upper bound.
Eigen::Vector3d interiorColor(const Eigen::Vector3d& color, const LightSettings& light,
                              double distance, double focus = 0.0, double facing = kInteriorFacing);

/// Slope, intensity per mm, at which soft tissue is lit half as a surface: the range of its
/// transfer function's points over 20 mm.
double softEdge(const appearance::TransferFunction& transfer);

/// Cosine of soft tissue: kInteriorFacing + w (|g . ray| / |g| - kInteriorFacing) with w = |g| /
/// (|g| + softEdge); gradient g, intensity per mm.
double softFacing(const Eigen::Vector3d& gradient, const Eigen::Vector3d& ray, double edge);

/// Background where the contents have no other; RGB, 0 to 1.
constexpr BackgroundColor kBackground = kDefaultBackground;

} // namespace optics
} // namespace petrous::rendering
