#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include <openssl/evp.h>

#include "petrous/Core/InputFile.h"
#include "petrous/Core/Progress.h"

namespace petrous::library
{

/// SHA-256 of bytes that come in pieces.
class Sha256
{
public:
  Sha256();
  void add(const void* bytes, std::size_t count);
  std::string hexadecimal(); ///< lower case, of all bytes added; nothing can be added after it

private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> m_context;
};

/// Gives a file's bytes to `write`, if there is one, block by block; returns their SHA-256 in
/// lower-case hexadecimal. Throws LibraryError if it cannot be read to its end.
std::string copied(const core::InputFile& file,
                   const std::function<void(const char*, std::size_t)>& write,
                   const core::Progress& progress, const char* task = "copying a file");

} // namespace petrous::library
