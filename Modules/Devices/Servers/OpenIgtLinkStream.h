#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace petrous::devices
{

/// A tracked tool by an OpenIGTLink message: TRANSFORM or POSITION.
struct TrackedPose
{
  std::string tool;      ///< the message's device name
  bool missing;          ///< the tracker says that it does not see the tool; the rest is void
  double position[3];    ///< mm
  double rotation[3][3]; ///< tool to tracker
};

/// Takes the bytes of an OpenIGTLink stream (protocol versions 1 to 3: header of 58 bytes, big
/// endian, CRC-64 of ECMA-182 over the body) and yields poses. Other messages are skipped, whatever
/// their size; those with a wrong checksum, an impossible size or no rotation are counted and left
/// out. A tool is missing by the metadata of version 2, as the PLUS Toolkit writes them:
/// TransformValid, TransformStatus.
class OpenIgtLinkStream
{
public:
  /// Appends the poses of whole messages in `bytes` and in what was left before.
  void take(const unsigned char* bytes, std::size_t count, std::vector<TrackedPose>& poses);

  std::uint64_t refused() const noexcept { return m_refused; }

  static std::uint64_t checksum(const unsigned char* bytes, std::size_t count);

private:
  std::vector<unsigned char> m_bytes; // an incomplete message
  std::uint64_t m_skip = 0;           // bytes of an uninteresting body still to come
  std::uint64_t m_refused = 0;
};

} // namespace petrous::devices
