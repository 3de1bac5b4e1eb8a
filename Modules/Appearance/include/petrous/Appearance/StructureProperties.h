#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include <nlohmann/json_fwd.hpp>

#include "petrous/Appearance/StructureAppearance.h"
#include "petrous/Core/NumberText.h"

namespace petrous::appearance
{

/// One property of a structure. Manifests, the catalogue of presets, `petrous appearance` and the
/// panel of structures are made from kStructureProperties: a new property is a member of
/// StructureAppearance (with its default), an entry there, and its use.
struct StructureProperty
{
  using Flag = bool StructureAppearance::*;
  using Text = std::string StructureAppearance::*;
  using Color = std::array<float, 3> StructureAppearance::*;
  using Transfer = std::optional<TransferFunction> StructureAppearance::*; ///< with `relative`
  using Member = std::variant<Flag, int StructureAppearance::*, float StructureAppearance::*,
                              double StructureAppearance::*, Text, Color, Transfer>;

  /// In a manifest.
  enum class Storage
  {
    Required,
    AsPreset,  ///< older manifests lack it: the preset's value
    UnlessOff, ///< left out while it is off; if missing, the default
    InFlags    ///< named in the list "flags" if it is set
  };

  /// Of `petrous appearance`; without a name there is none.
  struct Option
  {
    const char* name = nullptr;
    const char* value = ""; ///< as the help calls it
    const char* text = "";
    const char* notOfBone = nullptr; ///< why bone has no such property; nullptr: it has
  };

  /// Of the panel of structures, of a flag or a number; without a title there is none.
  struct Column
  {
    const char* title = nullptr;
    const char* tip = "";
  };

  const char* key; ///< in manifests and in the catalogue
  Member member;
  Storage storage;
  core::NumberRange range{};     ///< of a number, or of each component of a colour
  const char* off = nullptr;     ///< the word for 0, the empty text, no function
  const char* phrase = nullptr;  ///< before the value in a list; nullptr: not listed
  int decimals = -1;             ///< in a list and in the panel; -1: as many as there are
  const char* jsonKey = nullptr; ///< of --json, if it is not `key`
  const char* noun = "";         ///< as undo calls it: "warning distance"
  Option option{};
  Column column{};

  constexpr bool isNumber() const noexcept { return member.index() >= 1 && member.index() <= 3; }
  constexpr bool accepts(double value) const noexcept
  {
    return range.contains(value) || (off && value == 0.0);
  }

  // The words of the table: its storage first, then what holds besides.
  static constexpr StructureProperty required(const char* key, Member member)
  {
    return {key, member, Storage::Required};
  }
  static constexpr StructureProperty asPreset(const char* key, Member member)
  {
    return {key, member, Storage::AsPreset};
  }
  static constexpr StructureProperty unlessOff(const char* key, Member member)
  {
    return {key, member, Storage::UnlessOff};
  }
  static constexpr StructureProperty flag(const char* key, Member member)
  {
    return {key, member, Storage::InFlags};
  }
  constexpr StructureProperty within(double lower, double upper, const char* unit = "")
  {
    range = {lower, upper, unit};
    return *this;
  }
  constexpr StructureProperty offIs(const char* word)
  {
    off = word;
    return *this;
  }
  constexpr StructureProperty listedAs(const char* before, int digits = -1)
  {
    phrase = before;
    decimals = digits;
    return *this;
  }
  constexpr StructureProperty called(const char* name)
  {
    noun = name;
    return *this;
  }
  constexpr StructureProperty inJsonAs(const char* name)
  {
    jsonKey = name;
    return *this;
  }
  constexpr StructureProperty command(const char* name, const char* value, const char* text,
                                      const char* notOfBone = nullptr)
  {
    option = {name, value, text, notOfBone};
    return *this;
  }
  constexpr StructureProperty panel(const char* title, const char* tip)
  {
    column = {title, tip};
    return *this;
  }
};

/// In the order in which a list has them and in which `petrous appearance` applies them: a colour
/// after the transfer function that it tints.
inline constexpr StructureProperty kStructureProperties[] = {
    StructureProperty::required("preset", &StructureAppearance::preset).called("preset"),
    StructureProperty::flag("shown", &StructureAppearance::shown)
        .called("visibility")
        .panel("Show", "Drawn in 3D and outlined in the slices"),
    StructureProperty::flag("touchable", &StructureAppearance::touchable)
        .called("touch")
        .panel("Touch", "Felt by the burr: part of the tissue it rests on"),
    StructureProperty::flag("drillable", &StructureAppearance::drillable)
        .called("drilling")
        .panel("Drill", "Taken by the drill; without the mark the drill leaves it whole"),
    StructureProperty::required("solid", &StructureAppearance::solid).called("solidity"),
    StructureProperty::asPreset("tissue", &StructureAppearance::tissue)
        .called("material")
        .offIs("bone")
        .listedAs("drilled as ")
        .command("--tissue", "MATERIAL", "What the drill meets in it; 'bone': bone by its density",
                 "bone is what its density says; only structures and meshes have a tissue of their "
                 "own"),
    StructureProperty::unlessOff("stiffness_n_per_mm", &StructureAppearance::stiffness)
        .called("stiffness")
        .within(0.001, 100.0, "N/mm")
        .offIs("rigid")
        .listedAs("")
        .command(
            "--stiffness", "N_PER_MM|TISSUE",
            "How a structure yields: newtons a millimetre deep; or as a soft tissue (materials)",
            "bone is rigid; only structures and meshes can yield"),
    StructureProperty::asPreset("warn_mm", &StructureAppearance::warning)
        .called("warning distance")
        .within(0.0, 50.0, "mm")
        .offIs("none")
        .listedAs("warned of at ", 1)
        .command("--warn", "MM", "How near a burr may come before it is warned of",
                 "bone is what is drilled; only structures and meshes are warned of")
        .panel("Warn", "How near a burr may come before it is warned of, mm; 0: no warning. "
                       "Double click to change"),
    StructureProperty::required("opacity", &StructureAppearance::opacity)
        .called("opacity")
        .within(0.0, 1.0)
        .listedAs("opacity ", 2)
        .command("--opacity", "0..1", "Opacity of the surface"),
    StructureProperty::unlessOff("transfer", &StructureAppearance::transfer)
        .called("transfer function")
        .offIs("none")
        .command("--tf", "F.json", "Transfer function; 'none' for one colour"),
    StructureProperty::required("color", &StructureAppearance::color)
        .called("colour")
        .within(0.0, 1.0)
        .command("--color", "r,g,b", "Colour, 0 to 1 each, or #rrggbb"),
    StructureProperty::unlessOff("source_image", &StructureAppearance::sourceImage)
        .called("image")
        .inJsonAs("source")
        .offIs("ct")
        .listedAs("from ")
        .command("--source", "MRNAME", "The image whose intensities are read"),
    StructureProperty::unlessOff("shininess", &StructureAppearance::shininess)
        .called("shininess")
        .within(1.0, 200.0),
    StructureProperty::asPreset("priority", &StructureAppearance::priority)
        .called("priority")
        .within(0.0, 1000.0)};

/// Whether both have the same value of the property.
bool isEqual(const StructureAppearance& a, const StructureAppearance& b,
             const StructureProperty& property);

bool operator==(const StructureAppearance& a, const StructureAppearance& b);

/// Whether the value is the one that `off` names.
bool isOff(const StructureAppearance& look, const StructureProperty& property);

/// The value of a number; 0 of anything else.
double numberOf(const StructureAppearance& look, const StructureProperty& property);

/// Throws InvalidParameter naming property, range and value unless the number lies within the range
/// or is the 0 that is off.
void setNumber(StructureAppearance& look, const StructureProperty& property, double value);

/// A number or a text as lists show it, without its unit; if it is off, the word for that.
std::string toString(const StructureAppearance& look, const StructureProperty& property);

/// The value as a manifest has it; null: no transfer function.
nlohmann::json valueJson(const StructureAppearance& look, const StructureProperty& property);

/// The appearance as a manifest has it.
nlohmann::json appearanceJson(const StructureAppearance& look);

/// Reads `appearanceJson`; `preset`: for what manifests before a property lack. Throws
/// InvalidParameter naming a property out of its range, nlohmann::json::exception for a missing one
/// or one of another type.
StructureAppearance appearanceFrom(const nlohmann::json& json, const StructureAppearance& preset);

} // namespace petrous::appearance
