#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "DicomItem.h"
#include "petrous/Imaging/LabelFile.h"

namespace petrous::imaging
{

/// Characters of a long string (LO), which the label of a segment is.
constexpr int kLongestName = 64;

/// SOP Class UID of a DICOM file; "" if it is not one, or is damaged before it.
std::string sopClassOf(const std::filesystem::path& path);
bool isSegmentationClass(const std::string& sopClass);
bool isStructureSetClass(const std::string& sopClass);

/// Reads a DICOM segmentation (PS3.3 A.51): BINARY, FRACTIONAL (voxels of at least half the
/// maximum) and LABELMAP, in any byte order, uncompressed, deflated or losslessly compressed (RLE,
/// JPEG, JPEG-LS, JPEG 2000; frames of single bits: deflated only, as DICOM has it).
///
/// The grid is the frames' own: their orientation, and positions at even steps along the normal;
/// places without a frame are empty. Where the file declares no spacing of its slices that fits, it
/// is that of the first of `images` on whose slices all frames lie, else the frames' thickness,
/// else the smallest gap, the latter two noted unless they are one. Frames are read one at a time,
/// straight into the grid. Segments that overlap lie in several maps. Throws FileError (Unreadable
/// also if the voxels need more than `memory` bytes, 0: what the machine has left), CancelledError.
LoadedLabels readSegmentation(const std::filesystem::path& path, const core::Progress& progress,
                              const std::vector<ImageGrid>& images = {}, std::uint64_t memory = 0);

/// The code in an item of a code sequence (short, long or URN); its texts are in the character set
/// `characters` (0008,0005).
volume::CodedConcept codedConcept(const DicomItem& item, const std::string& characters);

/// MANUAL, SEMIAUTOMATIC or AUTOMATIC; otherwise Unknown.
volume::SegmentCodes::Algorithm algorithmFrom(const std::string& text);

/// sRGB (0 to 1) of a Recommended Display CIELab Value (PS3.3 C.10.7.1.1, relative to D50).
std::array<float, 3> colorFromCieLab(const std::vector<int>& value);

/// The inverse of colorFromCieLab.
std::array<std::uint16_t, 3> cieLabFromColor(const std::array<float, 3>& color);

} // namespace petrous::imaging
