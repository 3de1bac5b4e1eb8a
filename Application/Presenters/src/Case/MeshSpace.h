#pragma once

#include <filesystem>
#include <string>

#include "petrous/Imaging/MeshFile.h"
#include "petrous/Scene/ImagePart.h"

namespace petrous::presenters
{

/// Compares the spaces in which a surface file may count (RAS or LPS; mm, cm, inch or m) with the
/// image on which it was drawn: where the surface would lie, how large it would be, and, where
/// several are possible, whether it would follow the image's edges. What the user gave is not
/// judged; what the file states is, as a statement may be wrong. The file as it was read is the
/// first; the voxels are read only if another is possible.
///
/// Throws MeshSpaceUnclear if another space is the likelier one. Returns a remark for the user if
/// neither the file nor the image tells them apart, else an empty string.
std::string judgeMeshSpace(const std::filesystem::path& path, const imaging::LoadedMesh& loaded,
                           const scene::ImagePart& image, const std::string& imageName);

/// A remark for the user on a surface (patient LPS mm) that reaches more than half a voxel beyond
/// the image: how far, and the share of its area outside; else an empty string.
std::string outsideImage(const core::TriangleMesh& mesh, const core::GridGeometry& grid,
                         const std::string& imageName);

} // namespace petrous::presenters
