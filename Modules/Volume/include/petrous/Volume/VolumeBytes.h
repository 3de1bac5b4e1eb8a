#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "petrous/Volume/LabelField.h"

namespace petrous::volume
{

/// Lossless serialisation of volumes computed from labels, for a core::DerivedStore. Tiles that are
/// 0 or of one value take one to three bytes; zero tiles take no memory after reading either. Valid
/// only on machines of the same byte order.
using Bytes = std::vector<std::uint8_t>;

/// Returns nullopt if an occupancy is not a multiple of 1/65535 (SmoothedUnion.h).
std::optional<Bytes> bytesOf(const Volume<float>& occupancy);
std::optional<Bytes> bytesOf(const LabelField& field);
Bytes bytesOf(const LabelMap& labels);

/// Returns nullptr if the bytes are not of this kind.
std::shared_ptr<Volume<float>> occupancyFrom(const Bytes& bytes);
std::shared_ptr<LabelField> labelFieldFrom(const Bytes& bytes);
std::shared_ptr<LabelMap> labelMapFrom(const Bytes& bytes);

} // namespace petrous::volume
