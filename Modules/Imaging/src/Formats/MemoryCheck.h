#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace petrous::imaging
{

/// Before memory is touched: the system promises any size, and ends the program when it cannot keep
/// that. Throws FileError (Unreadable) if `bytes` are more than are free.
///
/// advice  what helps: "give a region of interest"
/// free    bytes; 0: what the machine has left
void requireMemory(const std::filesystem::path& path, std::uint64_t bytes,
                   const std::string& advice, std::uint64_t free = 0);

} // namespace petrous::imaging
