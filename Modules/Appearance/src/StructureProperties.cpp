#include "petrous/Appearance/StructureProperties.h"

#include <algorithm>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "petrous/Core/Error.h"

namespace petrous::appearance
{

namespace
{

using nlohmann::json;

/// A number as written into a member of type T.
template <class T>
T numberFrom(const StructureProperty& property, double value)
{
  if (!property.accepts(value))
    throw core::InvalidParameter(std::string(property.key) + ": " +
                                 property.range.refusal(value, property.off));
  return static_cast<T>(value);
}

void setValue(StructureAppearance& look, const StructureProperty& property, const json& value)
{
  std::visit(
      [&](auto member)
      {
        auto& target = look.*member;
        using T = std::decay_t<decltype(target)>;
        if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>)
          target = value.get<T>();
        else if constexpr (std::is_arithmetic_v<T>)
          target = numberFrom<T>(property, value.get<double>());
        else if constexpr (std::is_same_v<T, std::array<float, 3>>)
        {
          const auto color = value.get<std::array<double, 3>>();
          std::transform(color.begin(), color.end(), target.begin(),
                         [&property](double x) { return numberFrom<float>(property, x); });
        }
        else
        {
          json transfer = value;
          look.relative = transfer.value("relative", false);
          transfer.erase("relative");
          target = TransferFunction::fromJson(transfer.dump());
        }
      },
      property.member);
}

} // namespace

bool isEqual(const StructureAppearance& a, const StructureAppearance& b,
             const StructureProperty& property)
{
  return std::visit(
      [&](auto member)
      {
        constexpr bool isTransfer = std::is_same_v<decltype(member), StructureProperty::Transfer>;
        return a.*member == b.*member && (!isTransfer || a.relative == b.relative);
      },
      property.member);
}

bool operator==(const StructureAppearance& a, const StructureAppearance& b)
{
  return std::all_of(std::begin(kStructureProperties), std::end(kStructureProperties),
                     [&](const StructureProperty& property) { return isEqual(a, b, property); });
}

double numberOf(const StructureAppearance& look, const StructureProperty& property)
{
  return std::visit(
      [&look](auto member) -> double
      {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(look.*member)>>)
          return static_cast<double>(look.*member);
        else
          return 0.0;
      },
      property.member);
}

void setNumber(StructureAppearance& look, const StructureProperty& property, double value)
{
  std::visit(
      [&](auto member)
      {
        using T = std::decay_t<decltype(look.*member)>;
        if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
          look.*member = numberFrom<T>(property, value);
        else
          throw core::InvalidParameter(std::string(property.key) + ": is not a number");
      },
      property.member);
}

bool isOff(const StructureAppearance& look, const StructureProperty& property)
{
  if (const auto* text = std::get_if<StructureProperty::Text>(&property.member))
    return property.off && (look.*(*text)).empty();
  if (const auto* transfer = std::get_if<StructureProperty::Transfer>(&property.member))
    return !(look.*(*transfer)).has_value();
  return property.off && numberOf(look, property) == 0.0;
}

std::string toString(const StructureAppearance& look, const StructureProperty& property)
{
  if (isOff(look, property))
    return property.off;
  if (const auto* text = std::get_if<StructureProperty::Text>(&property.member))
    return look.*(*text);
  const double number = numberOf(look, property);
  return property.decimals < 0 ? core::exactText(number)
                               : core::fixedText(number, property.decimals);
}

json valueJson(const StructureAppearance& look, const StructureProperty& property)
{
  return std::visit(
      [&look](auto member) -> json
      {
        const auto& value = look.*member;
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>,
                                     std::optional<TransferFunction>>)
        {
          json transfer;
          if (value)
          {
            transfer = json::parse(value->toJson());
            transfer["relative"] = look.relative;
          }
          return transfer;
        }
        else
          return value;
      },
      property.member);
}

json appearanceJson(const StructureAppearance& look)
{
  using Storage = StructureProperty::Storage;
  json j{{"flags", flagsOf(look)}};
  for (const StructureProperty& property : kStructureProperties)
    if (property.storage != Storage::InFlags &&
        !(property.storage == Storage::UnlessOff && isOff(look, property)))
      j[property.key] = valueJson(look, property);
  return j;
}

StructureAppearance appearanceFrom(const json& j, const StructureAppearance& preset)
{
  using Storage = StructureProperty::Storage;
  StructureAppearance look;
  setFlags(look, j.at("flags").get<std::string>());
  for (const StructureProperty& property : kStructureProperties)
    if (property.storage == Storage::InFlags)
      continue;
    else if (j.contains(property.key) || property.storage == Storage::Required)
      setValue(look, property, j.at(property.key));
    else if (property.storage == Storage::AsPreset)
      setValue(look, property, valueJson(preset, property));
  return look;
}

} // namespace petrous::appearance
