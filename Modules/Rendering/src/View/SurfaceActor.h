#pragma once

#include <vector>

#include <Eigen/Core>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include "petrous/Core/TriangleMesh.h"
#include "petrous/Rendering/SceneContents.h"

class vtkActor;
class vtkPolyData;
class vtkPolyDataMapper;

namespace petrous::rendering
{

/// Triangles with a normal at each vertex; the normals' sense does not matter.
vtkSmartPointer<vtkPolyData> toPolyData(const core::TriangleMesh& mesh,
                                        const std::vector<Eigen::Vector3f>& normals);

/// Normals of the triangles round each vertex, weighted by area.
std::vector<Eigen::Vector3f> vertexNormals(const core::TriangleMesh& mesh);

/// A surface as the picture draws it: lit like bone, translucent by a screen-door pattern.
class SurfaceActor
{
public:
  /// `pattern` moves the screen door, so that neighbours in a list do not share it.
  explicit SurfaceActor(int pattern);
  ~SurfaceActor();

  vtkActor* prop() const;
  void setSurface(vtkPolyData* surface);
  void setLook(const appearance::StructureAppearance& look, const LightSettings& light);

private:
  int m_pattern;
  bool m_hasPattern = false;
  vtkNew<vtkPolyDataMapper> m_mapper;
  vtkNew<vtkActor> m_actor;
};

} // namespace petrous::rendering
