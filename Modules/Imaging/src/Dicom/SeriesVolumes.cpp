#include "SeriesVolumes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include "SliceStack.h"
#include "petrous/Core/NumberText.h"

namespace petrous::imaging
{

namespace
{

using Headers = std::vector<SliceHeader>;

/// A value that is the same for all slices of a stack.
struct Trait
{
  const char* name;
  std::function<std::string(const SliceHeader&)> valueOf; ///< empty: not stated
};

template <class T>
std::string textOf(const std::optional<T>& value)
{
  return value ? core::generalText(static_cast<double>(*value)) : std::string();
}

std::string listOf(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : "/") + word;
  return text;
}

/// What explains several slices at one place, the most telling first.
const std::vector<Trait>& traits()
{
  static const std::vector<Trait> kTraits = {
      {"modality", [](const SliceHeader& s) { return s.modality; }},
      {"stack", [](const SliceHeader& s) { return s.traits.stack; }},
      {"b", [](const SliceHeader& s) { return textOf(s.traits.bValue); }},
      {"gradient", [](const SliceHeader& s) { return s.traits.gradient; }},
      {"time", [](const SliceHeader& s) { return textOf(s.traits.temporal); }},
      {"echo", [](const SliceHeader& s) { return textOf(s.traits.echo); }},
      {"echo time", [](const SliceHeader& s) { return textOf(s.traits.echoTime); }},
      {"phase", [](const SliceHeader& s) { return textOf(s.traits.phasePercent); }},
      {"trigger time", [](const SliceHeader& s) { return textOf(s.traits.triggerTime); }},
      {"inversion time", [](const SliceHeader& s) { return textOf(s.traits.inversionTime); }},
      {"kernel", [](const SliceHeader& s) { return s.kernel; }},
      {"kV", [](const SliceHeader& s) { return textOf(s.tube); }},
      {"series number", [](const SliceHeader& s) { return textOf(s.seriesNumber); }},
      {"type", [](const SliceHeader& s) { return listOf(s.imageType); }},
      {"acquisition", [](const SliceHeader& s) { return textOf(s.acquisition); }}};
  return kTraits;
}

std::size_t duplicatesOf(const Headers& slices)
{
  if (slices.size() < 2)
    return 0;
  Headers copy = slices;
  return SliceStack(copy).duplicates();
}

using Groups = std::vector<NamedSlices>;

std::string joined(const std::string& name, const std::string& more)
{
  return name.empty() ? more : name + ", " + more;
}

/// The groups of `from` by one trait; one group if it does not tell stacks apart.
Groups byTrait(const NamedSlices& from, const Trait& trait)
{
  std::map<std::string, Headers> parts;
  std::vector<std::string> order; // of appearance, which is that of the instance numbers
  for (const SliceHeader& slice : from.slices)
  {
    const std::string value = trait.valueOf(slice);
    if (parts.count(value) == 0)
      order.push_back(value);
    parts[value].push_back(slice);
  }
  Groups groups;
  for (const std::string& value : order)
  {
    if (parts[value].size() < 2)
      return {from};
    const bool isNamed = trait.name == std::string("gradient") ? false : !value.empty();
    std::string name = std::string(trait.name) + " " + (isNamed ? value : std::string("-"));
    if (trait.name == std::string("gradient"))
      name = value.empty() ? "no gradient" : "gradient " + std::to_string(groups.size() + 1);
    groups.push_back({joined(from.name, name), std::move(parts[value])});
  }
  return groups;
}

/// Repetitions one after another: the instance numbers of each precede those of the next.
Groups byRepetition(const NamedSlices& from)
{
  Headers sorted = from.slices;
  const SliceStack byPlace(sorted); // sorts stably, so by instance number at each place
  std::vector<Headers> repeats;
  std::size_t at = 0;
  const Eigen::Vector3d normal =
      sorted.front().rowDirection->cross(*sorted.front().columnDirection);
  double place = 0.0;
  for (std::size_t k = 0; k < sorted.size(); ++k)
  {
    const double here = normal.dot(*sorted[k].position);
    at = k > 0 && here - place <= 1e-3 ? at + 1 : 0;
    place = here;
    if (at == repeats.size())
      repeats.emplace_back();
    repeats[at].push_back(sorted[k]);
  }
  int last = 0;
  Groups groups;
  for (Headers& repeat : repeats)
  {
    const auto [low, high] = std::minmax_element(repeat.begin(), repeat.end(),
                                                 [](const SliceHeader& a, const SliceHeader& b)
                                                 { return a.instanceNumber < b.instanceNumber; });
    if (repeat.size() != repeats.front().size() || repeat.size() < 2 ||
        (!groups.empty() && low->instanceNumber <= last))
      return {from};
    last = high->instanceNumber;
    groups.push_back(
        {joined(from.name, "repeat " + std::to_string(groups.size() + 1)), std::move(repeat)});
  }
  return groups;
}

std::size_t duplicatesOf(const Groups& groups)
{
  std::size_t count = 0;
  for (const NamedSlices& group : groups)
    count += duplicatesOf(group.slices);
  return count;
}

/// Splits a group until no two of its slices share a place, as far as the headers allow.
void splitPlaces(const NamedSlices& group, Groups& result)
{
  const std::size_t shared = duplicatesOf(group.slices);
  if (shared == 0)
  {
    result.push_back(group);
    return;
  }
  Groups best{group};
  std::size_t left = shared;
  for (const Trait& trait : traits())
  {
    Groups groups = byTrait(group, trait);
    if (groups.size() < 2)
      continue;
    const std::size_t count = duplicatesOf(groups);
    if (count < left)
    {
      left = count;
      best = std::move(groups);
    }
    if (left == 0)
      break;
  }
  if (best.size() < 2)
    best = byRepetition(group);
  if (best.size() < 2)
  {
    result.push_back(group);
    return;
  }
  for (const NamedSlices& part : best)
    splitPlaces(part, result);
}

std::string planeOf(const SliceHeader& slice)
{
  const Eigen::Vector3d normal = slice.rowDirection->cross(*slice.columnDirection).cwiseAbs();
  Eigen::Index axis = 0;
  normal.maxCoeff(&axis);
  return axis == 0 ? "sagittal" : axis == 1 ? "coronal" : "axial";
}

std::string sizeText(const SliceHeader& slice)
{
  return std::to_string(slice.columns) + " x " + std::to_string(slice.rows);
}

/// Groups of slices that agree with the first of each; those too small are set aside, as one.
Groups byLikeness(const NamedSlices& from,
                  const std::function<bool(const SliceHeader&, const SliceHeader&)>& alike,
                  const std::function<std::string(const SliceHeader&)>& nameOf)
{
  std::vector<Headers> parts;
  for (const SliceHeader& slice : from.slices)
  {
    const auto part = std::find_if(parts.begin(), parts.end(),
                                   [&](const Headers& p) { return alike(p.front(), slice); });
    if (part == parts.end())
      parts.push_back({slice});
    else
      part->push_back(slice);
  }
  std::vector<Headers> stacks;
  Headers rest;
  for (Headers& part : parts)
    if (part.size() >= kFewest)
      stacks.push_back(std::move(part));
    else
      rest.insert(rest.end(), part.begin(), part.end());
  if (stacks.size() < 2)
    return {from};
  Groups groups;
  for (Headers& stack : stacks)
  {
    const std::string name = joined(from.name, nameOf(stack.front()));
    groups.push_back({name, std::move(stack)});
  }
  if (!rest.empty())
    groups.push_back({joined(from.name, "set aside"), std::move(rest), true});
  return groups;
}

NamedSlices partOf(const NamedSlices& from, const Headers& sorted,
                   const std::vector<std::size_t>& members)
{
  NamedSlices part{from.name, {}};
  for (const std::size_t k : members)
    part.slices.push_back(sorted[k]);
  return part;
}

/// Mean centre of the slices, patient LPS mm.
Eigen::Vector3d centreOf(const Headers& slices)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const SliceHeader& s : slices)
    sum += *s.position + 0.5 * (s.columns - 1) * (*s.pixelSpacing)[1] * *s.rowDirection +
           0.5 * (s.rows - 1) * (*s.pixelSpacing)[0] * *s.columnDirection;
  return sum / static_cast<double>(slices.size());
}

/// "farther left": than the others, along the patient's axis in which they differ most. A scanner's
/// zero point need not be the patient's middle, so that no side of it says which ear is there.
void nameBySide(Groups& groups)
{
  Eigen::AlignedBox3d box;
  std::vector<std::pair<Eigen::Vector3d, NamedSlices*>> fields;
  for (NamedSlices& group : groups)
    if (group.isSetAside)
      group.name = joined(group.name, "set aside");
    else
      fields.emplace_back(centreOf(group.slices), &group);
  for (const auto& [centre, group] : fields)
    box.extend(centre);
  static constexpr const char* kSides[3][2] = {
      {"right", "left"}, {"anterior", "posterior"}, {"inferior", "superior"}};
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  std::stable_sort(fields.begin(), fields.end(),
                   [axis](const auto& a, const auto& b) { return a.first[axis] < b.first[axis]; });
  const std::size_t last = fields.size() - 1;
  for (std::size_t n = 0; n < fields.size(); ++n)
  {
    const std::string farther =
        std::string(fields.size() > 2 ? "farthest " : "farther ") + kSides[axis][n == last ? 1 : 0];
    NamedSlices& group = *fields[n].second;
    group.name = joined(group.name, n == 0 || n == last ? farther
                                                        : std::to_string(n + 1) + " of " +
                                                              std::to_string(fields.size()) +
                                                              " from the " + kSides[axis][0]);
  }
}

bool isOneColumn(const Headers& slices)
{
  if (slices.size() < 2)
    return true;
  Headers sorted = slices;
  const SliceStack stack(sorted);
  return stack.besides() == 0 && stack.columns().size() == 1;
}

/// Reconstructions beside each other, as of either ear: by what the headers say of them, else by
/// their place.
Groups byColumn(const NamedSlices& from)
{
  if (isOneColumn(from.slices))
    return {from};
  for (const Trait& trait : traits())
    if (Groups groups = byTrait(from, trait);
        groups.size() > 1 &&
        std::all_of(groups.begin(), groups.end(),
                    [](const NamedSlices& group) { return isOneColumn(group.slices); }))
      return groups;
  Headers sorted = from.slices;
  const auto columns = SliceStack(sorted).columns();
  if (columns.size() < 2)
    return {from};
  Groups groups;
  std::vector<bool> isOfColumn(sorted.size(), false);
  for (const auto& column : columns)
  {
    groups.push_back(partOf(from, sorted, column));
    for (const std::size_t k : column)
      isOfColumn[k] = true;
  }
  std::vector<std::size_t> rest;
  for (std::size_t k = 0; k < sorted.size(); ++k)
    if (!isOfColumn[k])
      rest.push_back(k);
  if (!rest.empty())
  {
    groups.push_back(partOf(from, sorted, rest));
    groups.back().isSetAside = true;
  }
  nameBySide(groups);
  return groups;
}

/// "tilt 20.0", "tilt -12.5": angles, degrees, of leans (SliceStack::lean), with their signs along
/// the axis in which they differ.
std::vector<std::string> tiltTexts(const std::vector<Eigen::Vector2d>& leans)
{
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& lean : leans)
    box.extend(lean);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  std::vector<std::string> texts;
  for (const Eigen::Vector2d& lean : leans)
  {
    const std::string degrees = decimals(std::atan(lean.norm()) * 180.0 / M_PI, 1);
    texts.push_back((lean[axis] < 0.0 && degrees != "0.0" ? "tilt -" : "tilt ") + degrees);
  }
  return texts;
}

/// The lean of slices that follow each other along the axis of the patient nearest to their normal.
Eigen::Vector2d leanOf(const SliceHeader& slice)
{
  const Eigen::Vector3d normal = slice.rowDirection->cross(*slice.columnDirection);
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return Eigen::Vector2d((*slice.rowDirection)[axis], (*slice.columnDirection)[axis]) /
         normal[axis];
}

/// Tells stacks of one plane apart by their tilts against it, where these differ.
void nameByTilt(Groups& groups)
{
  std::map<std::string, std::vector<NamedSlices*>> alike;
  for (NamedSlices& group : groups)
    if (!group.isSetAside && !group.slices.empty()) // empty: nothing of the series is placed
      alike[group.name].push_back(&group);
  for (const auto& [name, stacks] : alike)
  {
    std::vector<Eigen::Vector2d> leans;
    for (const NamedSlices* stack : stacks)
      leans.push_back(leanOf(stack->slices.front()));
    const std::vector<std::string> texts = tiltTexts(leans);
    if (std::set<std::string>(texts.begin(), texts.end()).size() < 2)
      continue;
    for (std::size_t n = 0; n < stacks.size(); ++n)
      stacks[n]->name = joined(stacks[n]->name, texts[n]);
  }
}

/// Stretches of one tilt each, of slices that are parallel and as a whole make no volume, even
/// repaired.
Groups byTilt(const NamedSlices& from)
{
  if (from.slices.size() < 2)
    return {from};
  Headers sorted = from.slices;
  const SliceStack stack(sorted);
  const std::vector<std::size_t> changes = stack.tiltChanges();
  if (changes.size() < 2 || assess(from.slices).verdict != Verdict::Refused)
    return {from};
  std::vector<Eigen::Vector2d> leans;
  Groups groups;
  for (std::size_t n = 0; n < changes.size(); ++n)
  {
    const std::size_t end = n + 1 < changes.size() ? changes[n + 1] : sorted.size();
    leans.push_back(stack.lean(changes[n], end));
    groups.push_back({from.name, Headers(sorted.begin() + static_cast<std::ptrdiff_t>(changes[n]),
                                         sorted.begin() + static_cast<std::ptrdiff_t>(end))});
  }
  const std::vector<std::string> texts = tiltTexts(leans);
  for (std::size_t n = 0; n < groups.size(); ++n)
    groups[n].name = joined(groups[n].name, texts[n]);
  return groups;
}

bool areAlike(const Headers& slices)
{
  return std::all_of(slices.begin(), slices.end(),
                     [&slices](const SliceHeader& slice) {
                       return sameTurn(slices.front(), slice) && sameSize(slices.front(), slice);
                     });
}

/// Slices of one orientation and size by column, by what tells those at one place apart, and by
/// tilt.
void splitStacks(const NamedSlices& from, Groups& result)
{
  for (const NamedSlices& column : byColumn(from))
  {
    if (column.isSetAside)
    {
      result.push_back(column);
      continue;
    }
    Groups places;
    splitPlaces(column, places);
    for (const NamedSlices& stack : places)
      for (NamedSlices& stretch : byTilt(stack))
        result.push_back(std::move(stretch));
  }
}

void makeDistinct(Groups& groups)
{
  std::set<std::string> names;
  for (NamedSlices& group : groups)
  {
    std::string name = group.name;
    for (int n = 2; !names.insert(name).second; ++n)
      name = group.name + " (" + std::to_string(n) + ")";
    group.name = name;
  }
}

} // namespace

std::vector<NamedSlices> splitVolumes(const std::vector<SliceHeader>& slices)
{
  NamedSlices all{"", {}};
  Headers others; // findings whichever stack they are with
  for (const SliceHeader& slice : slices)
  {
    const bool isUsable =
        slice.damage.empty() && slice.isImage && isPlaced(slice) && !isLocalizer(slice);
    (isUsable ? all.slices : others).push_back(slice);
  }
  std::stable_sort(all.slices.begin(), all.slices.end(),
                   [](const SliceHeader& a, const SliceHeader& b)
                   { return a.instanceNumber < b.instanceNumber; });
  Groups turned = byLikeness(all, sameTurn, planeOf);
  nameByTilt(turned);
  Groups groups;
  for (const NamedSlices& part : turned)
    if (part.isSetAside)
      groups.push_back(part);
    else
      for (const NamedSlices& sized : byLikeness(part, sameSize, sizeText))
        if (!sized.isSetAside && areAlike(sized.slices))
          splitStacks(sized, groups);
        else
          groups.push_back(sized); // places of slices turned against each other say nothing
  if (groups.size() < 2)
    return {{"", slices}};
  makeDistinct(groups);
  auto& largest = *std::max_element(groups.begin(), groups.end(),
                                    [](const auto& a, const auto& b)
                                    { return a.slices.size() < b.slices.size(); });
  largest.slices.insert(largest.slices.end(), others.begin(), others.end());
  return groups;
}

} // namespace petrous::imaging
