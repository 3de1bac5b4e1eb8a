#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Presenters/SlicePresenter.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::presenters
{

/// One of two approaches (branches), in the state in which it was left.
struct ComparedApproach
{
  std::string name;
  std::size_t strokes = 0;
  double drilling = 0.0;                   ///< s, of all strokes
  double removed = 0.0;                    ///< mm^3 of tissue
  double only = 0.0;                       ///< mm^3 of it that the other one left
  std::map<std::string, double> injured;   ///< mm^3 removed from each structure, as recorded
  std::map<std::string, double> exposed;   ///< mm^2 of each structure (scene::exposedSurfaces)
  std::map<std::string, double> distances; ///< mm from what was removed to each structure's
                                           ///< surface; 0: reached. None if nothing was removed
  std::shared_ptr<const volume::CutMask> mask;
};

/// Where tissue is that was removed by one of them, or by both.
enum class Difference : std::uint16_t
{
  None,
  OnlyFirst,
  OnlySecond,
  Both
};

/// Of each Difference but None: distinct also for who sees red and green alike.
constexpr std::array<std::array<float, 3>, 3> kDifferenceColors{
    {{0.90F, 0.62F, 0.0F}, {0.34F, 0.71F, 0.91F}, {0.80F, 0.80F, 0.80F}}};

struct ApproachComparison
{
  std::array<ComparedApproach, 2> sides;
  std::size_t commonStrokes = 0;
  double both = 0.0; ///< mm^3 removed by both
  /// mm, half-width of the distances to each structure, as dissectionDistances has it; none:
  /// unknown
  std::map<std::string, std::optional<double>> uncertainties;
  std::shared_ptr<const volume::CutMask> either; ///< what one of them removed is removed
  /// Of each Difference but None, patient LPS mm; null: none.
  std::array<std::shared_ptr<const core::TriangleMesh>, 3> surfaces;
  std::shared_ptr<const volume::TissueField> tissue; ///< before any mask

  Difference at(const core::Index3& voxel) const; ///< of the CT, at its centre
};

/// Compares two branches of a case whose dissection is loaded. Volumes as measureRemoved; distances
/// are those of RemovedTissue. Loads the CT, labels and meshes; takes seconds for many structures.
/// Throws InvalidParameter, CancelledError, and what loading throws.
ApproachComparison compareApproaches(const scene::Case& value, const std::string& first,
                                     const std::string& second,
                                     const core::Progress& progress = {});

/// Makes of the case's scene one in which both are removed, and what was is drawn in the colours of
/// the difference.
void showDifference(rendering::SceneContents& contents, const ApproachComparison& comparison);

/// The same over slices. Shares the comparison.
std::shared_ptr<const DraftLayer>
differenceLayer(const std::shared_ptr<const ApproachComparison>& comparison);

} // namespace petrous::presenters
