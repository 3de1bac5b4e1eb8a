#include "JpegDecoder.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmjpeg/djcparam.h>
#include <dcmtk/dcmjpeg/djdijg12.h>
#include <dcmtk/dcmjpeg/djdijg16.h>
#include <dcmtk/dcmjpeg/djdijg8.h>

namespace petrous::imaging
{

namespace
{

template <class Decoder>
class WatchedDecoder : public Decoder
{
public:
  using Decoder::Decoder;

  void emitMessage(int level) const override { m_warned = m_warned || level < 0; }
  bool hasWarned() const { return m_warned; }

private:
  mutable bool m_warned = false;
};

template <class Decoder>
bool decodeBy(std::vector<char>& codestream, std::vector<unsigned char>& cells)
{
  const DJCodecParameter parameters(ECC_lossyYCbCr, EDC_never, EUC_default, EPC_default);
  WatchedDecoder<Decoder> decoder(parameters, OFFalse);
  return decoder.init().good() &&
         decoder
             .decode(reinterpret_cast<Uint8*>(codestream.data()),
                     static_cast<Uint32>(codestream.size()), cells.data(),
                     static_cast<Uint32>(cells.size()), OFFalse)
             .good() &&
         !decoder.hasWarned();
}

} // namespace

bool isJpeg(const std::string& transferSyntax)
{
  return transferSyntax == "1.2.840.10008.1.2.4.50" || transferSyntax == "1.2.840.10008.1.2.4.51" ||
         transferSyntax == "1.2.840.10008.1.2.4.57" || transferSyntax == "1.2.840.10008.1.2.4.70";
}

bool decodeJpeg(std::vector<char>& codestream, int precision, std::vector<unsigned char>& cells)
{
  return precision <= 8    ? decodeBy<DJDecompressIJG8Bit>(codestream, cells)
         : precision <= 12 ? decodeBy<DJDecompressIJG12Bit>(codestream, cells)
                           : decodeBy<DJDecompressIJG16Bit>(codestream, cells);
}

} // namespace petrous::imaging
