#include "petrous/Imaging/SeriesGeometry.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

#include <Eigen/Geometry>

#include "SeriesVolumes.h"
#include "SliceStack.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::imaging
{

namespace
{

using Headers = std::vector<SliceHeader>;

constexpr double kFarthest = 1e5;       // mm; positions beyond are invalid
constexpr double kCoarsest = 1e3;       // mm
constexpr double kPerpendicular = 1e-3; // dot product of direction cosines; ten times rounding
constexpr double kUnitLength = 1e-2;

bool isFinite(const std::optional<Eigen::Vector3d>& v)
{
  return v && v->allFinite() && v->norm() < kFarthest;
}

bool isColour(const SliceHeader& slice)
{
  return slice.pixels.samplesPerPixel != 1 || slice.pixels.photometric == "PALETTE COLOR";
}

/// Removes the slices that satisfy `test` from `from` and returns them, order preserved.
Headers takeOut(Headers& from, const std::function<bool(const SliceHeader&)>& test)
{
  const auto rest = std::stable_partition(from.begin(), from.end(),
                                          [&test](const SliceHeader& s) { return !test(s); });
  Headers taken(std::make_move_iterator(rest), std::make_move_iterator(from.end()));
  from.erase(rest, from.end());
  return taken;
}

/// Keeps the largest group of equal slices (the first if tied); returns the others.
Headers takeMinority(Headers& from,
                     const std::function<bool(const SliceHeader&, const SliceHeader&)>& alike)
{
  std::vector<std::pair<const SliceHeader*, std::size_t>> groups;
  for (const SliceHeader& slice : from)
  {
    const auto group = std::find_if(groups.begin(), groups.end(),
                                    [&](const auto& g) { return alike(*g.first, slice); });
    if (group == groups.end())
      groups.emplace_back(&slice, 1);
    else
      ++group->second;
  }
  if (groups.size() < 2)
    return {};
  const auto largest = std::max_element(groups.begin(), groups.end(),
                                        [](auto& a, auto& b) { return a.second < b.second; });
  const SliceHeader model = *largest->first;
  return takeOut(from, [&](const SliceHeader& s) { return !alike(model, s); });
}

/// Keeps the largest group of slices whose keys agree, each with each other: one that states
/// nothing agrees with all and tells no group. Returns the others.
template <class KeyOf, class AreAlike>
Headers takeStrangers(Headers& from, const KeyOf& keyOf, const AreAlike& alike)
{
  using Key = std::decay_t<decltype(keyOf(from.front()))>;
  struct Group
  {
    std::vector<Key> keys;
    std::size_t slices = 0;
    bool fits(const Key& key, const AreAlike& areAlike) const
    {
      return std::all_of(keys.begin(), keys.end(),
                         [&](const Key& own) { return areAlike(own, key); });
    }
  };
  std::map<Key, std::size_t> counts;
  std::vector<Key> keys; // by first appearance
  for (const SliceHeader& slice : from)
    if (Key key = keyOf(slice); key != Key{} && counts[key]++ == 0)
      keys.push_back(std::move(key));
  std::vector<Group> groups;
  for (const Key& key : keys)
  {
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return g.fits(key, alike); });
    if (group == groups.end())
      group = groups.insert(groups.end(), Group());
    group->keys.push_back(key);
    group->slices += counts[key];
  }
  if (groups.size() < 2)
    return {};
  const auto largest = std::max_element(groups.begin(), groups.end(),
                                        [](auto& a, auto& b) { return a.slices < b.slices; });
  return takeOut(from, [&](const SliceHeader& s) { return !largest->fits(keyOf(s), alike); });
}

constexpr std::size_t kFilesNamed = 3; // keeps findings readable if a whole disc is bad

/// "a.dcm, b.dcm, c.dcm and 4 more".
std::string namesOf(const Headers& slices)
{
  std::string names;
  for (std::size_t i = 0; i < std::min(slices.size(), kFilesNamed); ++i)
    names += (i == 0 ? "" : ", ") + slices[i].file.filename().string();
  if (slices.size() > kFilesNamed)
    names += " and " + std::to_string(slices.size() - kFilesNamed) + " more";
  return names;
}

std::string countOf(std::size_t part, std::size_t whole)
{
  return std::to_string(part) + " of " + std::to_string(whole) +
         (whole == 1 ? " slice" : " slices");
}

Eigen::Vector2d fieldOfView(const SliceHeader& s) ///< width and height, mm
{
  return {s.columns * (*s.pixelSpacing)[1], s.rows * (*s.pixelSpacing)[0]};
}

double sizeError(const SliceHeader& a, const SliceHeader& b)
{
  return (fieldOfView(a) - fieldOfView(b)).cwiseAbs().maxCoeff();
}

/// Maximum corner displacement, mm, if one slice is placed with the direction cosines of the other.
double turnError(const SliceHeader& a, const SliceHeader& b)
{
  const Eigen::Vector2d field = fieldOfView(a);
  const Eigen::Vector3d along = (*a.rowDirection - *b.rowDirection) * field[0];
  const Eigen::Vector3d down = (*a.columnDirection - *b.columnDirection) * field[1];
  return std::max({along.norm(), down.norm(), (along + down).norm()});
}

double normalAngle(const SliceHeader& a, const SliceHeader& b) ///< degrees, 0 to 90
{
  const Eigen::Vector3d na = a.rowDirection->cross(*a.columnDirection).normalized();
  const Eigen::Vector3d nb = b.rowDirection->cross(*b.columnDirection).normalized();
  return std::acos(std::min(1.0, std::abs(na.dot(nb)))) * 180.0 / M_PI;
}

/// Largest angle between the rows, or the columns, of two slices, degrees, 0 to 180.
double axesAngle(const SliceHeader& a, const SliceHeader& b)
{
  const auto cosine = [](const Eigen::Vector3d& u, const Eigen::Vector3d& v)
  { return u.normalized().dot(v.normalized()); };
  return std::acos(std::clamp(std::min(cosine(*a.rowDirection, *b.rowDirection),
                                       cosine(*a.columnDirection, *b.columnDirection)),
                              -1.0, 1.0)) *
         180.0 / M_PI;
}

/// Whether the one is seen from the other side.
bool isMirrored(const SliceHeader& a, const SliceHeader& b)
{
  return a.rowDirection->cross(*a.columnDirection).dot(b.rowDirection->cross(*b.columnDirection)) <
         0.0;
}

/// Equal, or one of them not stated.
template <class T>
bool agree(const T& a, const T& b)
{
  return a == T{} || b == T{} || a == b;
}

/// PatientKey with an order.
using PatientTuple = std::tuple<std::size_t, std::size_t, std::size_t, std::size_t>;

PatientTuple patientTupleOf(const SliceHeader& slice)
{
  const PatientKey& key = slice.patient;
  return {key.id, key.issuer, key.name, key.birthDate};
}

bool isOnePatient(const PatientTuple& a, const PatientTuple& b)
{
  const auto key = [](const PatientTuple& t) {
    return PatientKey{std::get<0>(t), std::get<1>(t), std::get<2>(t), std::get<3>(t)};
  };
  return samePatient(key(a), key(b));
}

class Assessor
{
public:
  Assessor(Headers slices, const core::Progress& progress)
    : m_progress(progress)
    , m_slices(std::move(slices))
    , m_all(m_slices.size())
  {
    // The result must not depend on the order of the files.
    std::sort(m_slices.begin(), m_slices.end(),
              [](const SliceHeader& a, const SliceHeader& b)
              { return std::tie(a.instanceNumber, a.file) < std::tie(b.instanceNumber, b.file); });
  }

  SeriesGeometry run()
  {
    for (const auto step :
         {&Assessor::setAsideUnreadable, &Assessor::setAsideNonImages, &Assessor::setAsideStrangers,
          &Assessor::setAsideUnplaced, &Assessor::setAsideMinorities, &Assessor::judgeRescale,
          &Assessor::noteLoss, &Assessor::noteText, &Assessor::judgeStack, &Assessor::judgeDamaged,
          &Assessor::judgeAcquisitions})
    {
      m_progress.check("judging the slices");
      (this->*step)();
    }
    m_result.verdict = verdict();
    if (m_result.verdict == Verdict::Refused && m_duplicates > 0)
    {
      m_duplicates = 0;
      m_result.isRepairableIfEqual = verdict() == Verdict::Repairable;
    }
    m_result.slices = std::move(m_slices);
    return std::move(m_result);
  }

private:
  void find(FindingKind kind, const std::string& text, double errorMm = 0.0)
  {
    m_result.findings.push_back({kind, text, errorMm});
  }

  Verdict verdict() const
  {
    Verdict result = Verdict::Ok;
    for (const Finding& finding : m_result.findings)
      if ((finding.kind == FindingKind::LocalizerMixedIn && m_slices.size() > 1) ||
          finding.kind == FindingKind::MissingEnd || finding.kind == FindingKind::MissingBetween)
        continue; // set aside, or nothing that the slices show
      else if (isRepairable(finding.kind) && m_result.grid)
        result = Verdict::Repairable;
      else
        return Verdict::Refused;
    return result;
  }

  /// Whether the positions and values that the files state suffice for a straight volume.
  bool isRepairable(FindingKind kind) const
  {
    constexpr std::size_t kFew = 10; // one slice in so many may be there twice
    switch (kind)
    {
    case FindingKind::GantryTilt:
      return true;
    case FindingKind::MixedRescale:
      return !m_hasMixedTypes;
    case FindingKind::UnevenSpacing:
    case FindingKind::MissingSlice:
      return m_result.isBridgeable;
    case FindingKind::Unreadable:
      return m_damageIsMissing;
    case FindingKind::DuplicateSlice:
      return m_duplicates * kFew <= m_slices.size();
    default:
      return false;
    }
  }

  void setAsideUnreadable()
  {
    m_damaged = takeOut(m_slices, [](const SliceHeader& s) { return !s.damage.empty(); });
    const Headers& damaged = m_damaged;
    for (std::size_t i = 0; i < std::min(damaged.size(), kFilesNamed); ++i)
      find(FindingKind::Unreadable,
           damaged[i].file.filename().string() + " " + damaged[i].damage + ".");
    if (damaged.size() > kFilesNamed)
      find(FindingKind::Unreadable,
           std::to_string(damaged.size() - kFilesNamed) + " more files of the series are damaged.");
  }

  void setAsideNonImages()
  {
    const Headers others = takeOut(m_slices, [](const SliceHeader& s) { return !s.isImage; });
    if (!others.empty())
    {
      if (m_slices.empty())
        find(FindingKind::NotAnImage, "The DICOM objects hold no pixels (a report, a structure "
                                      "set or the like), so they are no image.");
      else
        m_result.notes.push_back(std::to_string(others.size()) +
                                 " DICOM objects without pixels were left out.");
    }
    const Headers multi = takeOut(m_slices, [](const SliceHeader& s) { return s.frames > 1; });
    if (!multi.empty())
      find(FindingKind::MultiFrame, std::to_string(multi.size()) +
                                        (multi.size() == 1 ? " file holds" : " files hold") +
                                        " many frames in one that are not those of an enhanced CT "
                                        "or MR; a DICOM segmentation is "
                                        "read as structures (--labels).");
    const Headers colour = takeOut(m_slices, isColour);
    if (!colour.empty() && m_slices.size() > colour.size())
      m_result.notes.push_back(countOf(colour.size(), m_all) +
                               " are pictures in colour (a report or a screenshot), and left out.");
    else if (!colour.empty())
      find(FindingKind::NotAnImage, "Colours instead of one CT or MR value a pixel in " +
                                        countOf(colour.size(), m_all) + ".");
  }

  /// A SeriesInstanceUID may be missing, or copied with the header from another series.
  void setAsideStrangers()
  {
    const std::size_t images = m_slices.size();
    const Headers others = takeStrangers(m_slices, patientTupleOf, isOnePatient);
    if (!others.empty())
      find(FindingKind::MixedPatients, "Another patient than in the rest is named in " +
                                           countOf(others.size(), images) +
                                           "; keep the files of one patient in the folder.");
    const std::size_t ofPatient = m_slices.size();
    const Headers studies = takeStrangers(
        m_slices, [](const SliceHeader& slice) { return slice.studyUid; }, agree<std::string>);
    if (!studies.empty())
      find(FindingKind::MixedStudies, "Another study than the rest is named in " +
                                          countOf(studies.size(), ofPatient) +
                                          "; keep the files of one study in the folder.");
  }

  void setAsideUnplaced()
  {
    const std::size_t images = m_slices.size();
    const bool mixed =
        !std::all_of(m_slices.begin(), m_slices.end(), isLocalizer) && !m_slices.empty();
    const Headers scouts = mixed ? takeOut(m_slices, isLocalizer) : Headers();
    m_scouts = scouts.size();
    const Headers unplaced = takeOut(m_slices, [](const SliceHeader& s) { return !isPlaced(s); });
    if (!unplaced.empty())
      find(FindingKind::NoGeometry, "No usable position, orientation and pixel spacing in " +
                                        countOf(unplaced.size(), images) + " (" +
                                        namesOf(unplaced) +
                                        "), so nothing says where they lie in the patient.");
    const Headers elsewhere =
        takeMinority(m_slices, [](const SliceHeader& a, const SliceHeader& b)
                     { return a.frameOfReferenceUid == b.frameOfReferenceUid; });
    if (!elsewhere.empty())
      find(FindingKind::NoGeometry,
           "Another frame of reference in " + countOf(elsewhere.size(), images) + " (" +
               namesOf(elsewhere) + "), so their place relative to the others is unknown.");
  }

  void setAsideMinorities()
  {
    const std::size_t placed = m_slices.size();
    const Headers turned = takeMinority(m_slices, sameTurn);
    std::size_t odd = 0;
    double worst = 0.0;
    double angle = 0.0; // between normals
    double turn = 0.0;  // between rows or columns
    bool hasMirrored = false;
    std::vector<std::pair<const SliceHeader*, std::size_t>> stacks; // first, and how many
    for (const SliceHeader& slice : turned)
    {
      const auto stack =
          std::find_if(stacks.begin(), stacks.end(),
                       [&slice](const auto& s) { return sameTurn(*s.first, slice); });
      if (stack == stacks.end())
        stacks.emplace_back(&slice, 1);
      else
        ++stack->second;
    }
    const bool isStack = std::any_of(stacks.begin(), stacks.end(),
                                     [](const auto& s) { return s.second >= kFewest; });
    for (const SliceHeader& slice : turned)
    {
      const double slant = normalAngle(slice, m_slices.front());
      // A few slices across a whole stack are scouts even if not labelled as such; as many as make
      // a stack may be a reformat.
      if (slant > 45.0 && turned.size() * 4 <= m_slices.size() && !isStack)
      {
        ++m_scouts;
        continue;
      }
      ++odd;
      worst = std::max(worst, turnError(m_slices.front(), slice));
      angle = std::max(angle, slant);
      turn = std::max(turn, axesAngle(slice, m_slices.front()));
      hasMirrored = hasMirrored || isMirrored(slice, m_slices.front());
    }
    if (m_scouts > 0)
      find(FindingKind::LocalizerMixedIn,
           std::to_string(m_scouts) +
               (m_scouts == 1 ? " localizer (scout) is" : " localizers (scouts) are") +
               " mixed in with the " + std::to_string(m_slices.size()) +
               " slices of the stack, and left out.");
    if (odd > 0)
      find(FindingKind::OddOrientation,
           countOf(odd, placed) + (hasMirrored ? " are turned or mirrored" : " are turned") +
               " against the others, their rows or columns by up to " + decimals(turn, 1) +
               " degrees" +
               (angle < 0.05 ? std::string(", within their plane")
                             : ", their normals by up to " + decimals(angle, 1) + " degrees") +
               "; read as one stack, their corners would lie up to " + decimals(worst, 1) +
               " mm off.",
           worst);

    const std::size_t straight = m_slices.size();
    const Headers sized = takeMinority(m_slices, sameSize);
    if (sized.empty())
      return;
    double error = 0.0;
    for (const SliceHeader& slice : sized)
      error = std::max(error, sizeError(slice, m_slices.front()));
    find(FindingKind::OddSize,
         countOf(sized.size(), straight) + " have another size than " +
             std::to_string(m_slices.front().columns) + " x " +
             std::to_string(m_slices.front().rows) + " pixels of " +
             decimals((*m_slices.front().pixelSpacing)[1], 3) + " x " +
             decimals((*m_slices.front().pixelSpacing)[0], 3) +
             " mm: their fields of view differ by " + decimals(error, 1) + " mm.",
         error);
  }

  void judgeRescale()
  {
    const Headers& s = m_slices;
    const auto different =
        std::count_if(s.begin(), s.end(),
                      [&s](const SliceHeader& a)
                      { return a.slope != s.front().slope || a.intercept != s.front().intercept; });
    const auto tables =
        std::count_if(s.begin(), s.end(), [](const SliceHeader& a) { return a.hasModalityLut; });
    if (tables > 0)
      find(FindingKind::ModalityLut,
           "A table (Modality LUT) says what the values mean in " +
               countOf(static_cast<std::size_t>(tables), s.size()) +
               ", and tables are not read; export the series with rescale slope and intercept.");
    std::string type; // of the first slice that states it
    for (const SliceHeader& slice : s)
      type = type.empty() ? slice.rescaleType : type;
    const auto otherTypes = std::count_if(
        s.begin(), s.end(), [&type](const SliceHeader& a) { return !agree(type, a.rescaleType); });
    m_hasMixedTypes = otherTypes > 0;
    if (otherTypes > 0)
      find(FindingKind::MixedRescale,
           "The slices do not share one unit of their values (Rescale Type): another than that of "
           "the first is stated in " +
               countOf(static_cast<std::size_t>(otherTypes), s.size()) +
               ", and no slope and intercept turns one into the other; keep the files of one in "
               "the folder.");
    if (different > 0)
      find(FindingKind::MixedRescale,
           "The slices do not share one rescale slope and intercept, so equal tissue may have "
           "unequal values; no position is affected (0 mm).");
  }

  void noteText()
  {
    auto worst = BurnedInText::None;
    for (const SliceHeader& slice : m_slices)
      worst = std::max(worst, slice.burnedIn);
    if (worst == BurnedInText::None)
      return;
    const auto count =
        std::count_if(m_slices.begin(), m_slices.end(),
                      [worst](const SliceHeader& slice) { return slice.burnedIn == worst; });
    m_result.notes.push_back(
        (worst == BurnedInText::Stated
             ? std::string("The header states text in the pixels (Burned In Annotation), in ")
             : "Text may be in the pixels, as of a screenshot or a converted image, in ") +
        countOf(static_cast<std::size_t>(count), m_slices.size()) +
        ": it may name the patient; look at the image before it is handed on.");
  }

  void noteLoss()
  {
    std::size_t lossy = 0;
    std::size_t unknown = 0;
    double ratio = 0.0;
    for (const SliceHeader& slice : m_slices)
    {
      lossy += slice.isLossy ? 1 : 0;
      unknown += slice.isLossUnknown ? 1 : 0;
      ratio = std::max(ratio, slice.lossyRatio.value_or(0.0));
    }
    if (unknown > 0)
      m_result.notes.push_back("Whether they were compressed with loss cannot be told of " +
                               countOf(unknown, m_slices.size()) +
                               ", as neither the header nor the compressed image says it.");
    if (lossy > 0)
      m_result.notes.push_back(
          "Compressed with loss" +
          (ratio > 0.0 ? ", to 1/" + decimals(ratio, 1) + " of the size" : std::string()) +
          ", in " + countOf(lossy, m_slices.size()) +
          ": values are not those measured, and thin walls may be blurred; the archive may have "
          "the series without loss.");
  }

  /// Slices of several scans may form an evenly spaced stack, each scan between the slices of the
  /// other.
  void judgeAcquisitions()
  {
    if (m_slices.size() < 2)
      return;
    const auto differs = [this](const auto& valueOf)
    {
      using Value = std::decay_t<decltype(valueOf(m_slices.front()))>;
      Value stated{}; // of the first slice that states it
      for (const SliceHeader& slice : m_slices)
      {
        if (!agree(stated, valueOf(slice)))
          return true;
        if (stated == Value{})
          stated = valueOf(slice);
      }
      return false;
    };
    std::string what;
    const auto add = [&what](const char* text)
    { what += (what.empty() ? "" : ", ") + std::string(text); };
    if (differs([](const SliceHeader& s) { return s.modality; }))
      add("modalities");
    if (differs([](const SliceHeader& s) { return s.seriesNumber; }))
      add("series numbers");
    if (differs([](const SliceHeader& s) { return s.kernel; }))
      add("reconstruction kernels");
    if (differs([](const SliceHeader& s) { return s.tube; }))
      add("tube voltages");
    if (isInterleaved())
      add("acquisitions that take turns along the stack");
    if (!what.empty())
      find(FindingKind::MixedAcquisitions,
           "The slices are of several scans or reconstructions: they differ in " + what +
               ", so neighbours may show equal tissue unequally and at different times; keep the "
               "files of one in the folder.");
    else
      noteWait();
  }

  /// The next part of a stack may have been scanned after the patient moved.
  void noteWait()
  {
    constexpr int kLong = 5; // minutes; a scan in steps takes less
    int longest = 0;
    std::size_t before = 0; // slices
    for (std::size_t n = 1; n < m_slices.size(); ++n)
    {
      const SliceHeader& a = m_slices[n - 1];
      const SliceHeader& b = m_slices[n];
      if (a.modality != "CT" || a.acquisition == b.acquisition)
        continue;
      if (const int apart = minutesApart(a.taken, b.taken); apart > longest)
      {
        longest = apart;
        before = n;
      }
    }
    if (longest >= kLong)
      m_result.notes.push_back(
          "Slices " + std::to_string(before) + " and " + std::to_string(before + 1) +
          " were acquired " + std::to_string(longest) +
          " minutes apart. If the patient moved meanwhile there is a step between them that no "
          "patient has: look at bone that goes through.");
  }

  /// Of SliceHeader::taken; 0: not known, or not of one day.
  static int minutesApart(const std::string& a, const std::string& b)
  {
    constexpr std::size_t kDay = 9, kMinute = kDay + 4; // "20200131 1205"
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    if (a.size() != kMinute || b.size() != kMinute || a.compare(0, kDay, b, 0, kDay) != 0 ||
        !std::all_of(a.begin() + kDay, a.end(), isDigit) ||
        !std::all_of(b.begin() + kDay, b.end(), isDigit))
      return 0;
    const auto minuteOf = [](const std::string& taken)
    {
      const auto digit = [&taken](std::size_t n) { return taken[kDay + n] - '0'; };
      return 60 * (10 * digit(0) + digit(1)) + 10 * digit(2) + digit(3);
    };
    return std::abs(minuteOf(a) - minuteOf(b));
  }

  /// A damaged file is a slice as good as missing if it says that it stands in a gap of the stack.
  /// Anywhere else it may have been an end of the stack, or of another one.
  void judgeDamaged()
  {
    const bool hasGap =
        std::any_of(m_result.findings.begin(), m_result.findings.end(),
                    [](const Finding& f) { return f.kind == FindingKind::MissingSlice; });
    m_damageIsMissing =
        hasGap && m_result.grid &&
        std::all_of(m_damaged.begin(), m_damaged.end(),
                    [this](const SliceHeader& slice) { return standsInGap(slice); });
  }

  bool standsInGap(const SliceHeader& slice) const
  {
    const SliceHeader& first = m_slices.front();
    if (!isPlaced(slice) || !sameTurn(first, slice) || !sameSize(first, slice) ||
        slice.frameOfReferenceUid != first.frameOfReferenceUid ||
        !std::all_of(m_slices.begin(), m_slices.end(),
                     [&slice](const SliceHeader& s) {
                       return samePatient(s.patient, slice.patient) &&
                              agree(s.studyUid, slice.studyUid);
                     }))
      return false;
    const Eigen::Vector3d normal = first.rowDirection->cross(*first.columnDirection).normalized();
    const double place = normal.dot(*slice.position);
    const auto above =
        std::find_if(m_slices.begin(), m_slices.end(),
                     [&](const SliceHeader& s) { return normal.dot(*s.position) > place; });
    if (above == m_slices.begin() || above == m_slices.end())
      return false;
    const double apart = 0.5 * m_result.grid->spacing()[2];
    return normal.dot(*above->position) - place > apart &&
           place - normal.dot(*std::prev(above)->position) > apart;
  }

  /// Whether an acquisition number reappears after another one. Scanners that acquire a stack in
  /// steps number the steps consecutively. Interleaving within one MR scan is usual: there the
  /// slices must also overlap.
  bool isInterleaved() const
  {
    std::vector<int> runs;
    for (const SliceHeader& slice : m_slices)
      if (slice.acquisition && (runs.empty() || runs.back() != *slice.acquisition))
        runs.push_back(*slice.acquisition);
    std::sort(runs.begin(), runs.end());
    if (std::adjacent_find(runs.begin(), runs.end()) == runs.end())
      return false;
    const SliceHeader& first = m_slices.front();
    constexpr double kOverlap = 1.5; // thickness / spacing
    return first.modality == "CT" || (first.thickness && m_result.grid &&
                                      *first.thickness > kOverlap * m_result.grid->spacing()[2]);
  }

  void judgeStack()
  {
    if (m_slices.size() < 2)
    {
      if (m_slices.empty() && m_result.findings.empty())
        find(FindingKind::NotAnImage, "There is no slice.");
      if (m_slices.size() == 1 && m_result.findings.empty())
        find(FindingKind::NoGeometry, "One slice alone has no thickness that its position could "
                                      "show; a stack of at least 2 slices is needed.");
      return;
    }
    SliceStack stack(m_slices);
    m_duplicates = stack.duplicates();
    stack.judge(m_result);
    try
    {
      m_result.grid = stack.grid();
    }
    catch (const core::InvalidParameter&)
    {
      find(FindingKind::NoGeometry, "The slices' positions do not make a grid.");
    }
  }

  const core::Progress& m_progress;
  Headers m_slices;
  Headers m_damaged;
  bool m_hasMixedTypes = false;   ///< of the rescaled values
  bool m_damageIsMissing = false; ///< each damaged file is one of the missing slices
  std::size_t m_all;
  std::size_t m_scouts = 0;
  std::size_t m_duplicates = 0;
  SeriesGeometry m_result;
};

} // namespace

bool isPlaced(const SliceHeader& slice)
{
  if (!isFinite(slice.position) || !isFinite(slice.rowDirection) ||
      !isFinite(slice.columnDirection) || !slice.pixelSpacing || slice.rows < 1 ||
      slice.columns < 1)
    return false;
  const Eigen::Vector2d& spacing = *slice.pixelSpacing;
  return spacing.allFinite() && spacing.minCoeff() > 0.0 && spacing.maxCoeff() < kCoarsest &&
         std::abs(slice.rowDirection->norm() - 1.0) < kUnitLength &&
         std::abs(slice.columnDirection->norm() - 1.0) < kUnitLength &&
         std::abs(slice.rowDirection->dot(*slice.columnDirection)) < kPerpendicular;
}

bool sameSize(const SliceHeader& a, const SliceHeader& b)
{
  return a.rows == b.rows && a.columns == b.columns && sizeError(a, b) <= kJitterTolerance;
}

bool isLocalizer(const SliceHeader& slice)
{
  return std::find(slice.imageType.begin(), slice.imageType.end(), "LOCALIZER") !=
         slice.imageType.end();
}

bool sameTurn(const SliceHeader& a, const SliceHeader& b)
{
  return turnError(a, b) <= kJitterTolerance;
}

const char* kindName(FindingKind kind) noexcept
{
  switch (kind)
  {
  case FindingKind::GantryTilt:
    return "gantry-tilt";
  case FindingKind::MissingSlice:
    return "missing-slice";
  case FindingKind::UnevenSpacing:
    return "uneven-spacing";
  case FindingKind::DuplicateSlice:
    return "duplicate-slice";
  case FindingKind::SideBySide:
    return "side-by-side";
  case FindingKind::OddOrientation:
    return "odd-orientation";
  case FindingKind::OddSize:
    return "odd-size";
  case FindingKind::MixedRescale:
    return "mixed-rescale";
  case FindingKind::ModalityLut:
    return "modality-lut";
  case FindingKind::MixedPatients:
    return "mixed-patients";
  case FindingKind::MixedStudies:
    return "mixed-studies";
  case FindingKind::MixedAcquisitions:
    return "mixed-acquisitions";
  case FindingKind::NoGeometry:
    return "no-geometry";
  case FindingKind::LocalizerMixedIn:
    return "localizer-mixed-in";
  case FindingKind::MissingEnd:
    return "missing-end";
  case FindingKind::MissingBetween:
    return "missing-between";
  case FindingKind::MultiFrame:
    return "multi-frame";
  case FindingKind::NotAnImage:
    return "not-an-image";
  case FindingKind::Unreadable:
    return "unreadable";
  }
  return "unreadable";
}

const char* verdictName(Verdict verdict) noexcept
{
  return verdict == Verdict::Ok ? "ok" : verdict == Verdict::Repairable ? "repairable" : "refused";
}

BurnedInText burnedInText(const std::string& annotation, const std::string& modality,
                          const std::string& sopClass, const std::string& imageType,
                          bool isConverted)
{
  if (annotation == "YES")
    return BurnedInText::Stated;
  if (annotation == "NO")
    return BurnedInText::None;
  static const char* const kModalities[] = {"SC", "OT",  "US", "ES",  "XC",
                                            "GM", "DOC", "SM", "IVUS"};
  const std::string kSecondary = "1.2.840.10008.5.1.4.1.1.7"; // capture; with a dot, multi-frame
  const bool isSuspected = std::find(std::begin(kModalities), std::end(kModalities), modality) !=
                               std::end(kModalities) ||
                           sopClass == kSecondary || sopClass.rfind(kSecondary + ".", 0) == 0 ||
                           imageType.find("SCREEN") != std::string::npos || isConverted;
  return isSuspected ? BurnedInText::Suspected : BurnedInText::None;
}

PixelFaults pixelFaults(const std::vector<SliceHeader>& slices)
{
  PixelFaults faults;
  for (const SliceHeader& slice : slices)
  {
    faults.burnedIn = std::max(faults.burnedIn, slice.burnedIn);
    faults.isLossy = faults.isLossy || slice.isLossy;
    if (slice.lossyRatio && *slice.lossyRatio > faults.lossyRatio.value_or(0.0))
      faults.lossyRatio = slice.lossyRatio;
  }
  return faults;
}

bool isInterpolated(const SliceHeader& slice)
{
  return std::find(slice.imageType.begin(), slice.imageType.end(), kInterpolatedType) !=
         slice.imageType.end();
}

SeriesGeometry assess(std::vector<SliceHeader> slices, const core::Progress& progress)
{
  return Assessor(std::move(slices), progress).run();
}

} // namespace petrous::imaging
