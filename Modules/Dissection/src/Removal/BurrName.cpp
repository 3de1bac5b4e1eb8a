#include "petrous/Dissection/BurrName.h"

namespace petrous::dissection
{

const char* nameOf(Burr::Kind kind) noexcept
{
  return kind == Burr::Kind::Cutting ? "cutting" : "diamond";
}

std::optional<Burr::Kind> parseBurrKind(const std::string& name)
{
  for (const Burr::Kind kind : {Burr::Kind::Cutting, Burr::Kind::Diamond})
    if (name == nameOf(kind))
      return kind;
  return std::nullopt;
}

} // namespace petrous::dissection
