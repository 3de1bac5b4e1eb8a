#pragma once

#include <Eigen/Core>

#include "petrous/Appearance/Material.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering
{

/// What a ray sees: the one definition behind the GPU's picture (shaders/RayCast.frag.glsl) and the
/// reference (ReferenceRayCaster), after [Chan2013, 2.2] and [Chan2016, "Visual rendering"].
///
/// At a point x the ray is in one of these states, f being the tissue field of what is shown:
///   air              f <= 0, outside the hull of the CT's voxel centres, that of the crop box's or
///                    a clipping plane; a hull without thickness is air
///   bone             f > 0 and share <= 0.5
///   structure i      f > 0 and share > 0.5, i = volume::structureAt(x): the label index of the
///                    voxel nearest to x, and where two structures meet, the one that has most of
///                    the eight voxels round x (Volume/LabelBorders.h)
/// Where the state changes from air to anything, or to a structure from whatever else, there is a
/// surface; all other changes only change the material. A surface adds its lit colour with the
/// material's surface opacity; along the way through a tissue colour and extinction of the
/// material's transfer function are integrated:
///   C = sum_surfaces T a_s c_s + integral T sigma(v) c(v) l ds,  T the transmittance so far
/// A ray ends at opaque polygons; what is left of T shows what is behind.
///
/// Surface at x, unit normal n (out of the tissue; -grad of the operand that decides: c_CT, share
/// or mask, central differences over +-1 voxel of its grid; for bone -> structure that of share;
/// from structure to structure i that of how deep in i a place lies (without borders: of how much
/// belongs to i), the 27 voxels round x weighted by quadratic B-splines;
/// c_CT by edgeGradientInPatient where the material's surface opacity is kSmoothOpacity or more):
///   v       intensity at x - n * kColorDepth * (smallest spacing of the CT), clamped to the hull
///           of the image that is read
///   c_s     surfaceColor(transfer(v), |n . ray|, distance along the ray)
///   opacity material.surfaceOpacity
/// The material is i's from structure to structure i; else structureAt(x)'s where share > 0.5 -
/// 1e-3 at x, else a lumen's where the index at x is one of a lumen, else bone. Where tissue is cut
/// off by the hull, the crop box or a clipping plane, n is that face's normal and v is taken at x
/// itself. A flat field (n = 0) faces the eye, and so does tissue that the eye stands in. The first
/// surface gives the depth, whatever its opacity.
///
/// Thickness over a structure: where a surface that is no such face has bone's material or a
/// lumen's, and d, the distance to the structure there (trilinear, ThicknessOverlay), lies below
/// `farthest`, the colour of the transfer function gives way to thicknessColor(d / farthest); its
/// light and highlight stay.
namespace optics
{

/// How far below the surface the intensity is taken that colours it, in smallest spacings. Nearer
/// to it partial volume with air draws the voxels' contour lines on smooth bone.
constexpr double kColorDepth = 2.0;

/// Cosine that stands for all directions inside a scattering tissue (no normal is taken there).
constexpr double kInteriorFacing = 2.0 / 3.0;

/// Exponent of the highlight of a wet surface.
constexpr double kWetShininess = 120.0;

constexpr double kOccupancyThreshold = 0.5 - 1e-3;

/// Surface opacity from which the CT's surface is lit without the steps of its slices. What is seen
/// through shows them less, and a ray meets many such surfaces.
constexpr double kSmoothOpacity = 0.5;

/// Light that arrives at a distance (mm) from the lamp at the eye: intensity / (1 + (d /
/// falloff)^2), or intensity where falloff is 0.
double lightAt(const LightSettings& light, double distance);

/// light (c (ambient + (1 - ambient) facing) + k_s specular facing^shininess
///        + wetness facing^kWetShininess), clamped to 0..1; k_s of the transfer function.
Eigen::Vector3d surfaceColor(const appearance::TransferFunction::Optics& optics, double shininess,
                             double cosine, const LightSettings& light, double distance);

/// light c (ambient + (1 - ambient) kInteriorFacing), clamped to 0..1.
Eigen::Vector3d interiorColor(const Eigen::Vector3d& color, const LightSettings& light,
                              double distance);

/// What is behind everything; RGB, 0 to 1.
constexpr double kBackground[3] = {0.105, 0.115, 0.130};

} // namespace optics
} // namespace petrous::rendering
