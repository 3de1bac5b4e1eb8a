#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "petrous/Volume/LabelField.h"

namespace petrous::volume
{

/// Volumes that are made from labels, as bytes for a core::DerivedStore, and back to the last bit.
/// Tiles that are 0 or of one value take a byte or three, and no memory when they come back where
/// they are 0. Bytes hold on machines of the same byte order only.
using Bytes = std::vector<std::uint8_t>;

/// Nothing where an occupancy is no multiple of 1/65535 (SmoothedUnion.h).
std::optional<Bytes> bytesOf(const Volume<float>& occupancy);
std::optional<Bytes> bytesOf(const LabelField& field);
Bytes bytesOf(const LabelMap& labels);

/// Null where the bytes are none of the kind.
std::shared_ptr<Volume<float>> occupancyFrom(const Bytes& bytes);
std::shared_ptr<LabelField> labelFieldFrom(const Bytes& bytes);
std::shared_ptr<LabelMap> labelMapFrom(const Bytes& bytes);

} // namespace petrous::volume
