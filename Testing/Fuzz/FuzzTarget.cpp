// A libFuzzer target for one reader, PETROUS_FUZZ_READER (Documentation/developing.md).

#include <cstddef>
#include <cstdint>

#include "HostileReaders.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const petrous::testing::HostileReaders readers;
  readers.accepts(PETROUS_FUZZ_READER, {reinterpret_cast<const char*>(data), size});
  return 0;
}
