#pragma once

#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/Volume.h"

namespace petrous::rendering
{

/// The surface of value 0 of a field by flying edges, patient LPS mm, counter-clockwise seen from
/// where the field is negative; also on left-handed grids.
core::TriangleMesh isoTriangles(const volume::Volume<float>& field);

} // namespace petrous::rendering
