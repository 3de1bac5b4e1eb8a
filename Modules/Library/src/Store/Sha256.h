#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <openssl/evp.h>

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

} // namespace petrous::library
