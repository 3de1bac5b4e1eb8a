#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "petrous/Core/AxesCorrection.h"
#include "petrous/Core/Progress.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// What of a case does not come along where the axes of its primary image are corrected, as it lies
/// by another image, by a registration to it as it was, or in it.
struct LeftBehind
{
  std::vector<std::string> mr;        ///< names
  std::vector<std::string> drawnOnMr; ///< names of structures and meshes
  std::size_t strokes = 0;            ///< of all approaches
  std::size_t measurements = 0;
  std::size_t attachments = 0;
  std::size_t savedViews = 0;
};
LeftBehind leftBehind(const scene::Case& value);

/// A new case, not saved, of a case's primary image with its axes corrected, after any correction
/// that it has: its voxels are not copied. What lies in its patient space, label maps and meshes,
/// comes along; which ear it is is open again. The given case stays. Throws InvalidParameter for
/// the identity; what reading voxels throws; CancelledError.
scene::Case correctedCase(const scene::Case& value, const core::AxesCorrection& axes,
                          const std::string& name, const core::Progress& progress = {});

/// A part of a case whose axes can be corrected. What it is says which one is meant where a name is
/// there twice, in older cases.
struct AxesPart
{
  enum class Kind
  {
    Mr,
    Structure,
    Mesh
  };
  Kind kind;
  std::string name;
};
/// The part of that name; the MR before the structure before the mesh, as kindOfPart. Throws
/// InvalidParameter if the case has no such MR, structure or mesh.
AxesPart axesPart(const scene::Case& value, const std::string& name);

/// What else changes where the axes of an MR, a structure or a mesh are corrected.
struct AxesFollowers
{
  std::vector<std::string> parts;        ///< structures and meshes that follow
  std::vector<std::string> unregistered; ///< MRs whose registration ends
};
/// `part`: of axesPart. May read label maps.
AxesFollowers axesFollowers(const scene::Case& value, const AxesPart& part);

/// Corrects the axes of a part of a case, after any correction that it has, as `--mr-axes`,
/// `--labels-axes` and `--mesh-axes` do of a file:
/// MR         about the centre of its grid, with what was drawn on it; it is not registered any
///            more, nor are those that are registered through it
/// structure  with all that lie on its label map, also in other parts, about the centre of the
///            image on which it was drawn
/// mesh       about the centre of the image on which it was drawn
/// What was measured along a structure or to one that moves does not follow it any more
/// (scene::forgetStructure). `part` of axesPart. Voxels are not copied. Throws InvalidParameter for
/// the identity, Error (Refused) if strokes record what was removed from one that would move; what
/// reading them throws. Strong exception guarantee.
void correctPart(scene::Case& value, const AxesPart& part, const core::AxesCorrection& axes);

/// The structures and meshes of `before` that correctPart moved in `after`.
std::vector<std::string> movedNames(const scene::Case& before, const scene::Case& after);

} // namespace petrous::presenters
