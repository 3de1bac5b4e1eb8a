#pragma once

#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/Volume.h"

namespace petrous::rendering
{

/// Isosurface 0 of a field by flying edges, patient LPS mm, counter-clockwise seen from the
/// negative side, on left-handed grids too.
core::TriangleMesh isoTriangles(const volume::Volume<float>& field);

} // namespace petrous::rendering
