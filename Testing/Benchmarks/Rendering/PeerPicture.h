#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/CameraPose.h"
#include "petrous/Rendering/SceneContents.h"

class vtkRenderer;

namespace petrous::rendering
{

/// VTK's mappers, as peers of ours in a benchmark.
enum class Peer
{
  GpuComposite,  ///< vtkGPUVolumeRayCastMapper: CT only
  GpuLabelMap,   ///< the same with labels and cut as a label map mask, one transfer function each
  GpuMulti,      ///< vtkMultiVolume: CT and smoothed union as two volumes; no cut
  CpuFixedPoint, ///< vtkFixedPointVolumeRayCastMapper: CT only, on the CPU
  SmartGpu,      ///< vtkSmartVolumeMapper on the GPU, as it is: soft tissue alone
  SmartCpu       ///< the same on the CPU
};

std::string nameOf(Peer peer);

/// A control point of a peer's transfer functions.
struct PeerControlPoint
{
  double value = 0.0;            ///< HU
  std::array<double, 3> color{}; ///< RGB, 0 to 1
  double opacity = 0.0;          ///< of 1 mm
};

/// Bone as mappers without surfaces draw it: invisible below the iso value `below`, and of an
/// opaque surface an opaque interior.
std::vector<PeerControlPoint> peerTable(const appearance::Material& material, double below);

/// Tangent of the angle between our lamp and the view axis, towards the picture's upper edge.
double lampTilt();

/// A scene as drawn by a peer: composite, shaded, linear, sampling distance 0.5 of the smallest
/// spacing, no automatic adjustment. Bone has the scene's transfer function above the iso value.
///
/// The optical model differs from ours (no explicit surfaces, gradients that ignore the cut), so
/// times are compared, but no error. That of soft tissue alone, of light that is all ambient, is
/// the same: emission and absorption by one transfer function, unshaded.
class PeerPicture
{
public:
  static constexpr double kStep = 0.5; ///< in units of the smallest CT spacing

  /// Throws RenderingError BadContents if the scene lacks a CT, or the labels, mask or soft tissue
  /// that this peer draws.
  PeerPicture(Peer peer, const SceneContents& contents, const core::CameraPose& camera);
  ~PeerPicture();
  PeerPicture(const PeerPicture&) = delete;
  PeerPicture& operator=(const PeerPicture&) = delete;

  void attach(vtkRenderer* renderer);
  void setCamera(const core::CameraPose& camera); ///< after `attach`
  /// Frames a second that vtkSmartVolumeMapper is to reach by its own adjustment; from 1 on it
  /// takes the scene to be moving. After `attach`; the window keeps it.
  void setUpdateRate(double hertz);

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
