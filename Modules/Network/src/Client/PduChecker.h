#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace petrous::network
{

/// Follows the bytes of a connection from PDU to PDU (PS3.8 9.3) and tells what is none. DCMTK
/// waits for as many bytes as a PDU states, and for the end of a connection on which something else
/// came: until its time is up.
class PduChecker
{
public:
  /// Takes the next bytes. Returns what is wrong with them: "a PDU of type 72"; empty: nothing.
  /// Nothing is taken after that.
  std::string take(const std::uint8_t* bytes, std::size_t count);

private:
  enum class Part
  {
    Header,    // of a PDU: type, reserved, length
    Fields,    // of an association, before its items
    Item,      // type, reserved, length
    PdvLength, // of a presentation data value
    Body       // not looked at
  };

  std::string next();
  std::string begin();
  void read(Part part, std::size_t size);
  std::uint32_t number(std::size_t from, std::size_t size) const;

  Part m_part = Part::Header;
  std::size_t m_needed = 6; ///< bytes of the part that are still to come
  std::array<std::uint8_t, 6> m_bytes{};
  std::size_t m_read = 0; ///< of m_bytes
  std::uint8_t m_type = 0;
  std::uint32_t m_left = 0; ///< of the PDU behind the part
};

} // namespace petrous::network
