#pragma once

#include <cstdint>

namespace petrous::imaging
{

/// Component types of voxels in files.
enum class Component
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float,
  Double
};

/// Calls visitor(T{}) with the C++ type of a component.
template <class Visitor>
decltype(auto) visitComponent(Component component, Visitor&& visitor)
{
  switch (component)
  {
  case Component::Int8:
    return visitor(std::int8_t{});
  case Component::UInt8:
    return visitor(std::uint8_t{});
  case Component::Int16:
    return visitor(std::int16_t{});
  case Component::UInt16:
    return visitor(std::uint16_t{});
  case Component::Int32:
    return visitor(std::int32_t{});
  case Component::UInt32:
    return visitor(std::uint32_t{});
  case Component::Int64:
    return visitor(std::int64_t{});
  case Component::UInt64:
    return visitor(std::uint64_t{});
  case Component::Float:
    return visitor(float{});
  case Component::Double:
    break;
  }
  return visitor(double{});
}

} // namespace petrous::imaging
