#include "petrous/Dissection/BurrName.h"

#include <algorithm>

#include "petrous/Core/Error.h"

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

std::string nameOf(const Burr& burr)
{
  return burr.name.empty() ? nameOf(burr.kind) : burr.name;
}

bool isCatalogueName(const std::string& name) noexcept
{
  return !name.empty() && name.size() <= 40 &&
         std::all_of(name.begin(), name.end(),
                     [](char c)
                     { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; });
}

void setName(Burr& burr, const std::string& name)
{
  if (!name.empty() && !isCatalogueName(name))
    throw core::InvalidParameter("a burr's name must have a to z, 0 to 9 and hyphens, at most 40");
  burr.name = name == nameOf(burr.kind) ? std::string() : name;
}

} // namespace petrous::dissection
