#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace petrous::imaging
{

/// Whether a transfer syntax is JPEG (ITU-T T.81): baseline, extended and lossless.
bool isJpeg(const std::string& transferSyntax);

/// Decodes one component by DCMTK, whose decoders survive damaged streams. `precision`: bits of a
/// sample by the frame header. `cells`: rows * columns samples of one byte up to 8 bits, else of
/// two, little-endian. False if the stream is damaged, also where decoding could go on with a
/// warning. Thread-safe.
bool decodeJpeg(std::vector<char>& codestream, int precision, std::vector<unsigned char>& cells);

} // namespace petrous::imaging
