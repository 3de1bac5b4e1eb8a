#pragma once

#include <memory>
#include <string>

#include "petrous/Core/CameraPose.h"
#include "petrous/Rendering/SceneContents.h"

class vtkRenderer;

namespace petrous::rendering
{

/// The mappers that VTK brings, as peers of ours in a benchmark.
enum class Peer
{
  GpuComposite, ///< vtkGPUVolumeRayCastMapper: the CT alone
  GpuLabelMap,  ///< the same with labels and cut as a label map mask, a transfer function each
  GpuMulti,     ///< vtkMultiVolume: CT and smoothed union as two volumes; no cut
  CpuFixedPoint ///< vtkFixedPointVolumeRayCastMapper: the CT alone, on the processor
};

std::string nameOf(Peer peer);

/// The scene as a peer can draw it: composite, shaded, linear, samples 0.5 of the smallest spacing
/// apart, no adjustment of its own. Bone has the scene's transfer function above the iso value.
///
/// The optics are others than ours (no surfaces of their own, gradients that ignore the cut), so
/// there is a time to compare and no error.
class PeerPicture
{
public:
  static constexpr double kStep = 0.5; ///< smallest spacings of the CT

  /// Throws RenderingError BadContents when the scene has no CT, or lacks the labels or mask that
  /// this peer draws.
  PeerPicture(Peer peer, const SceneContents& contents, const core::CameraPose& camera);
  ~PeerPicture();
  PeerPicture(const PeerPicture&) = delete;
  PeerPicture& operator=(const PeerPicture&) = delete;

  void attach(vtkRenderer* renderer);

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
