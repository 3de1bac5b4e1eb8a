#include "RecordingFormat.h"

#include <memory>

#include <zstd.h>

#include "petrous/Core/Error.h"

namespace petrous::session
{

namespace
{

constexpr int kLevel = 3;

struct FreeContext
{
  void operator()(ZSTD_CCtx* context) const noexcept { ZSTD_freeCCtx(context); }
};

} // namespace

std::vector<std::uint8_t> pack(const std::vector<std::uint8_t>& raw)
{
  const std::unique_ptr<ZSTD_CCtx, FreeContext> context(ZSTD_createCCtx());
  std::vector<std::uint8_t> packed(ZSTD_compressBound(raw.size()));
  std::size_t size = 0;
  if (context)
  {
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
    size = ZSTD_compress2(context.get(), packed.data(), packed.size(), raw.data(), raw.size());
  }
  if (!context || ZSTD_isError(size))
    throw core::Error(core::Fault::Internal, "recording: could not be compressed");
  packed.resize(size);
  return packed;
}

bool unpack(const std::vector<std::uint8_t>& packed, std::size_t most,
            std::vector<std::uint8_t>& raw)
{
  const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN || size > most)
    return false;
  raw.resize(static_cast<std::size_t>(size));
  return ZSTD_decompress(raw.data(), raw.size(), packed.data(), packed.size()) == raw.size();
}

} // namespace petrous::session
