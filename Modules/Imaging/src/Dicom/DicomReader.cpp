#include "petrous/Imaging/DicomReader.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "MixedSigns.h"
#include "PaddingRange.h"
#include "PixelCodec.h"
#include "SeriesRepair.h"
#include "SliceStack.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/SystemMemory.h"

namespace petrous::imaging
{

namespace
{

using core::GridGeometry;
using core::IndexBox;
using volume::IntensityVolume;
using volume::Volume;

constexpr double kAir = -1024.0; // HU; the minimum of most CTs

/// Minimum and maximum of a set of values; initially empty.
struct Span
{
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  bool empty() const { return min > max; }
  void add(double value)
  {
    min = std::min(min, value);
    max = std::max(max, value);
  }
  template <class T>
  bool fits() const
  {
    return empty() || (min >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
                       max <= static_cast<double>(std::numeric_limits<T>::max()));
  }
};

bool isWhole(double value)
{
  return value == std::nearbyint(value) && std::abs(value) < 1e9;
}

double rescaled(const SliceHeader& slice, double stored)
{
  return slice.slope * stored + slice.intercept;
}

/// Statistics of filling the volume.
struct Contents
{
  Span real;                  ///< values that are not padding
  bool isPadded = false;      ///< padding occurs in the box
  bool cornersPadded = false; ///< padding occurs in a slice corner, as outside a circular field
  double rounding = 0.0;      ///< of whole and 64-bit values, by the float in which they are kept
};

/// A padding that no value of the bits stored has, so that it is none of tissue.
bool isBeyondStored(const SliceHeader& slice)
{
  const PixelFormat& format = slice.pixels;
  if (!slice.padding || format.isReal)
    return false;
  const double count = std::ldexp(1.0, format.bitsStored);
  return *slice.padding < (format.isSigned ? -0.5 * count : 0.0) ||
         *slice.padding >= (format.isSigned ? 0.5 * count : count);
}

class SeriesReader
{
public:
  /// `require` throws if the volume does not fit the memory with so many bytes a voxel.
  SeriesReader(const DicomSeries& series, const IndexBox& box, UndeclaredBits undeclared,
               const std::function<void(std::size_t)>& require, const core::Progress& progress)
    : m_slices(series.geometry.slices)
    , m_modality(series.modality)
    , m_geometry(series.geometry.grid->cropped(box))
    , m_box(box)
    , m_undeclared(undeclared)
    , m_require(require)
    , m_progress(progress)
    , m_signs(m_slices.size())
    , m_undeclaredPixels(m_slices.size(), 0)
  {
  }

  IntensityVolume read(std::vector<std::string>* notes)
  {
    m_notes = notes;
    if (m_undeclared == UndeclaredBits::Keep)
      judgeKeep();
    judgeMixedSigns();
    try
    {
      IntensityVolume result = read();
      noteUndeclared();
      return result;
    }
    catch (const DicomError& error)
    {
      if (error.reason() != DicomError::Reason::BitsUnclear)
        throw;
      if (const BitsFound found = lookAtBits(); found.pixels > 0)
        failUndeclared(found);
      throw; // the file was changed meanwhile
    }
  }

private:
  IntensityVolume read()
  {
    Span declared;
    bool whole = true;
    for (int k = m_box.lower[2]; k < m_box.upper[2]; ++k)
    {
      const SliceHeader& slice = m_slices[static_cast<std::size_t>(k)];
      const PixelFormat& pixels = slice.pixels;
      whole = whole && !pixels.isReal && isWhole(slice.slope) && isWhole(slice.intercept);
      const bool isKept = m_undeclared == UndeclaredBits::Keep && !pixels.isReal;
      const double count = std::ldexp(1.0, isKept ? pixels.bitsAllocated : pixels.bitsStored);
      declared.add(rescaled(slice, pixels.isSigned ? -0.5 * count : 0.0));
      declared.add(rescaled(slice, pixels.isSigned ? 0.5 * count - 1.0 : count - 1.0));
    }
    m_needsRange = (whole && !declared.fits<std::int16_t>() && !declared.fits<std::uint16_t>()) ||
                   std::any_of(m_slices.begin(), m_slices.end(),
                               [](const SliceHeader& s) { return s.padding.has_value(); });
    if (!whole)
      return *tryRead<float>();
    if (declared.fits<std::int16_t>() || !declared.fits<std::uint16_t>())
      // 16 bits stored with an intercept of -1024 declare a larger range than is used.
      if (auto result = tryRead<std::int16_t>())
        return *result;
    if (auto result = tryRead<std::uint16_t>())
      return *result;
    return *tryRead<float>();
  }

  /// nullopt if a real value does not fit T; the memory is freed then.
  template <class T>
  std::optional<IntensityVolume> tryRead()
  {
    if (!m_contents.real.fits<T>()) // known from an earlier attempt
      return std::nullopt;
    m_require(sizeof(T));
    auto voxels = std::make_shared<Volume<T>>(m_geometry);
    bool usePadding = true;
    T stand = standIn<T>();
    fill(*voxels, stand, usePadding);
    if (!m_contents.real.fits<T>())
      return std::nullopt;
    judgeSigns();
    if (m_contents.rounding > 0.0)
      note("Values were rounded to 32-bit floating point, by up to " +
           core::plainText(m_contents.rounding, 3) + ".");
    if (!m_contents.isPadded || m_contents.real.empty())
      return IntensityVolume(std::shared_ptr<const Volume<T>>(voxels));

    const double lowest = m_contents.real.min;
    if (static_cast<double>(stand) <= lowest && paddingValue() <= lowest)
      return IntensityVolume(std::shared_ptr<const Volume<T>>(voxels), static_cast<double>(stand));
    const std::string value = decimals(paddingValue(), 0);
    if (!m_contents.cornersPadded)
    {
      // Some writers declare a tissue value (0, water) as padding; then it occurs only inside.
      usePadding = false;
      fill(*voxels, stand, usePadding);
      if (!m_contents.real.fits<T>())
        return std::nullopt;
      note("The header calls the value " + value +
           " padding, but it does not fill the corners of "
           "any slice; it is kept as an ordinary value.");
      return IntensityVolume(std::shared_ptr<const Volume<T>>(voxels));
    }
    const auto target =
        static_cast<T>(std::max(m_modality == "CT" ? std::min(lowest, kAir) : lowest,
                                static_cast<double>(std::numeric_limits<T>::lowest())));
    replace(*voxels, stand, target);
    note("Padding had the value " + value + ", which would pass for tissue; it was replaced by " +
         decimals(static_cast<double>(target), 0) + ".");
    return static_cast<double>(target) < lowest
               ? IntensityVolume(std::shared_ptr<const Volume<T>>(voxels),
                                 static_cast<double>(target))
               : IntensityVolume(std::shared_ptr<const Volume<T>>(voxels));
  }

  void judgeMixedSigns()
  {
    const MixedSigns signs = mixedSigns(m_slices, static_cast<std::size_t>(m_box.lower[2]),
                                        static_cast<std::size_t>(m_box.upper[2]), m_progress);
    if (!signs.unclear.empty())
      throw DicomError(DicomError::Reason::Unreadable, signs.unclear);
    if (signs.slices > 0)
      note("Of " + std::to_string(signs.slices) + " slices " + std::to_string(signs.unsignedOnes) +
           (signs.unsignedOnes == 1 ? " says" : " say") +
           " that the pixels are unsigned, the others that they are signed; no value depends on "
           "it.");
  }

  /// One slice without copies of the sign cannot tell a negative value from a positive one that is
  /// too large; the others of the series can. Kept, they are told apart already.
  void judgeSigns()
  {
    const auto bare = bareSigns();
    if (bare == m_signs.end() || m_undeclared == UndeclaredBits::Keep)
      return;
    const SliceHeader& slice = sliceOf(bare);
    if (!copiesOfSign())
      return note("Values whose highest stored bit is set were read as negative, as the header "
                  "says (signed, Bits Stored " +
                  std::to_string(slice.pixels.bitsStored) +
                  "); no bit above tells them from positive ones that are too large. Look whether "
                  "metal shows as air.");
    if (m_undeclared == UndeclaredBits::Refuse)
      throw DicomError(DicomError::Reason::BitsUnclear, bitsStoredText(slice, bare->none));
  }

  /// The first slice of the box whose negative values, if they are, have no copies of the sign.
  /// Where a slice has both, StoredPixels::undeclared counts them.
  std::vector<SignCopies>::const_iterator bareSigns() const
  {
    return std::find_if(m_signs.begin(), m_signs.end(),
                        [](const SignCopies& s) { return isBare(s); });
  }

  static bool isBare(const SignCopies& signs) { return signs.none > 0 && !signs.any; }

  /// The first slice found whose negative values have copies of the sign, in the box or outside of
  /// it; null: none has. For when the slices of the box are known.
  const SliceHeader* copiesOfSign()
  {
    if (m_copies)
      return *m_copies;
    auto copies = std::find_if(m_signs.begin(), m_signs.end(),
                               [](const SignCopies& signs) { return signs.any; });
    StoredPixels pixels;
    for (auto n = m_signs.begin(); copies == m_signs.end() && n != m_signs.end(); ++n)
    {
      const auto k = static_cast<int>(n - m_signs.begin());
      if (k >= m_box.lower[2] && k < m_box.upper[2])
        continue; // read already
      m_progress.check("reading slices");
      // What lies outside of the box tells signs alone.
      decodePixels(sliceOf(n), pixels, UndeclaredBits::LeaveOut);
      copies = pixels.signs.any ? n : copies;
    }
    m_copies = copies == m_signs.end() ? nullptr : &sliceOf(copies);
    return *m_copies;
  }

  /// Pixels of a slice of the box that UndeclaredBits is about, by what all slices tell.
  std::size_t undeclaredIn(std::size_t slice)
  {
    const SignCopies& signs = m_signs[slice];
    return m_undeclaredPixels[slice] + (isBare(signs) && copiesOfSign() ? signs.none : 0);
  }

  /// Bits are kept in all slices or in none, and where the sign of each value is known: what is
  /// negative would turn positive without copies of the sign.
  void judgeKeep()
  {
    const BitsFound found = lookAtBits();
    if (found.pixels == 0)
      m_undeclared = UndeclaredBits::Refuse;
    else if (!found.canKeep())
      failUndeclared(found);
  }

  void noteUndeclared()
  {
    std::size_t count = 0;
    for (std::size_t n = 0; n < m_slices.size(); ++n)
      count += undeclaredIn(n);
    if (count > 0)
      note(std::to_string(count) + (count == 1 ? " pixel has" : " pixels have") +
           " bits beside those stored that the file does not declare (Bits Stored); they were " +
           (m_undeclared == UndeclaredBits::Keep
                ? "kept, as if stored, as asked. Look whether air or tissue shows as metal there."
                : "left out, as DICOM says. Look whether metal shows as tissue or air there."));
  }

  /// The pixels of the box that UndeclaredBits is about.
  struct BitsFound
  {
    const SliceHeader* first = nullptr; ///< of the slices that have some
    std::size_t pixels = 0;
    std::size_t slices = 0;
    std::size_t bare = 0;         ///< pixels without the copies of the sign that others have
    bool hasBitsBelow = false;    ///< in one of the slices
    bool areSignsUnclear = false; ///< a value may be negative without copies of its sign
    bool canKeep() const { return !hasBitsBelow && !areSignsUnclear; }
  };

  BitsFound lookAtBits()
  {
    std::vector<char> below(m_slices.size(), 0);
    tbb::enumerable_thread_specific<StoredPixels> buffers;
    tbb::parallel_for(tbb::blocked_range<int>(m_box.lower[2], m_box.upper[2], 1),
                      [&](const tbb::blocked_range<int>& r)
                      {
                        StoredPixels& pixels = buffers.local();
                        for (int k = r.begin(); k != r.end(); ++k)
                        {
                          m_progress.check("reading slices");
                          const auto n = static_cast<std::size_t>(k);
                          pixels.hasBitsBelow = false;
                          decodePixels(m_slices[n], pixels, UndeclaredBits::LeaveOut);
                          m_signs[n] = pixels.signs;
                          m_undeclaredPixels[n] = pixels.undeclared;
                          below[n] = pixels.hasBitsBelow ? 1 : 0;
                        }
                      });
    BitsFound found;
    found.areSignsUnclear = bareSigns() != m_signs.end() && !copiesOfSign();
    for (int k = m_box.lower[2]; k < m_box.upper[2]; ++k)
    {
      const auto n = static_cast<std::size_t>(k);
      const std::size_t pixels = undeclaredIn(n);
      if (pixels == 0)
        continue;
      found.first = found.first ? found.first : &m_slices[n];
      found.pixels += pixels;
      ++found.slices;
      found.bare += pixels - m_undeclaredPixels[n];
      found.hasBitsBelow = found.hasBitsBelow || below[n] != 0;
    }
    return found;
  }

  /// What leaving the bits out gives and what keeping them does, for the user to choose.
  void failUndeclared(const BitsFound& found)
  {
    Span left;
    Span kept;
    double beside = 0.0;
    std::size_t besideCount = 0;
    StoredPixels without;
    StoredPixels with;
    for (int k = m_box.lower[2]; found.canKeep() && k < m_box.upper[2]; ++k)
    {
      m_progress.check("reading slices");
      const SliceHeader& slice = m_slices[static_cast<std::size_t>(k)];
      if (undeclaredIn(static_cast<std::size_t>(k)) == 0)
        continue;
      decodePixels(slice, without, UndeclaredBits::LeaveOut);
      decodePixels(slice, with, UndeclaredBits::Keep);
      const auto isUndeclared = [&](std::size_t n) { return without.at(n) != with.at(n); };
      for (std::size_t n = 0; n < without.size(); ++n)
      {
        if (!isUndeclared(n))
          continue;
        left.add(rescaled(slice, without.at(n)));
        kept.add(rescaled(slice, with.at(n)));
        const auto column = n % static_cast<std::size_t>(slice.columns);
        for (const bool isNext : {false, true})
          if (isNext ? column + 1 < static_cast<std::size_t>(slice.columns) : column > 0)
            if (const std::size_t other = isNext ? n + 1 : n - 1; !isUndeclared(other))
            {
              beside += rescaled(slice, without.at(other));
              ++besideCount;
            }
      }
    }
    const std::string choice =
        !left.empty()
            ? "Left out, as DICOM says of bits that are not stored (--bits stored), the values "
              "are " +
                  rangeText(left) +
                  "; kept, for metal in a file whose header is wrong (--bits allocated), they "
                  "are " +
                  rangeText(kept)
        : found.areSignsUnclear
            ? std::string("They can be left out, as DICOM says of bits that are not stored (--bits "
                          "stored), but not kept: no copies of the sign tell negative values, "
                          "such as air, from metal, and air would turn into metal")
            : std::string("They can be left out, as DICOM says of bits that are not stored (--bits "
                          "stored), but not kept: unused bits lie below the values");
    const std::string others = besideCount == 0
                                   ? std::string()
                                   : "; beside them lies " +
                                         decimals(beside / static_cast<double>(besideCount), 0) +
                                         " on average";
    std::string where =
        found.slices > 1 ? ", in " + std::to_string(found.slices) + " slices" : std::string();
    if (found.bare > 0)
      where += (found.bare == found.pixels ? ": without the copies of the sign that the negative "
                                             "values of "
                                           : ": some without the copies of the sign that the "
                                             "negative values of ") +
               (*m_copies)->file.filename().string() + " have";
    throw BitsUnclearError(bitsStoredText(*found.first, found.pixels, where) +
                               ", and nothing says what they are. " + choice + others +
                               ". Or export it again, uncompressed and with all bits",
                           !left.empty());
  }

  static std::string rangeText(const Span& span)
  {
    return decimals(span.min, 0) +
           (span.max > span.min ? " to " + decimals(span.max, 0) : std::string());
  }

  const SliceHeader& sliceOf(std::vector<SignCopies>::const_iterator signs) const
  {
    return m_slices[static_cast<std::size_t>(signs - m_signs.begin())];
  }

  /// The padding value of the first slice that has one, rescaled.
  double paddingValue() const
  {
    for (const SliceHeader& slice : m_slices)
    {
      const PaddingRange<double> padding(slice, true);
      if (!padding.empty())
        return std::min(rescaled(slice, padding.low), rescaled(slice, padding.high));
    }
    return 0.0;
  }

  /// Value of padding voxels until it is known whether their own value can be kept: one that no
  /// other voxel has.
  template <class T>
  T standIn() const
  {
    const SliceHeader& first = m_slices.front();
    const bool shared = std::all_of(m_slices.begin(), m_slices.end(),
                                    [&](const SliceHeader& s)
                                    {
                                      return s.slope == first.slope &&
                                             s.intercept == first.intercept &&
                                             s.padding == first.padding &&
                                             s.paddingRangeLimit == first.paddingRangeLimit;
                                    });
    Span value;
    value.add(paddingValue());
    return shared && value.fits<T>() ? static_cast<T>(value.min) : std::numeric_limits<T>::lowest();
  }

  template <class T>
  void fill(Volume<T>& voxels, T stand, bool usePadding)
  {
    m_contents = {};
    tbb::enumerable_thread_specific<StoredPixels> buffers;
    std::atomic<int> done{0};
    const int count = m_box.upper[2] - m_box.lower[2];
    tbb::parallel_for(tbb::blocked_range<int>(0, count, 1),
                      [&](const tbb::blocked_range<int>& r)
                      {
                        for (int k = r.begin(); k != r.end(); ++k)
                        {
                          fillSlice(k, voxels, stand, usePadding, buffers.local());
                          m_progress.report(static_cast<double>(++done) / count, "reading slices");
                        }
                      });
  }

  template <class T>
  void fillSlice(int k, Volume<T>& voxels, T stand, bool usePadding, StoredPixels& pixels)
  {
    const SliceHeader& slice = m_slices[static_cast<std::size_t>(m_box.lower[2] + k)];
    decodePixels(slice, pixels, m_undeclared);
    m_signs[static_cast<std::size_t>(m_box.lower[2] + k)] = pixels.signs;
    m_undeclaredPixels[static_cast<std::size_t>(m_box.lower[2] + k)] = pixels.undeclared;
    if (pixels.isReal())
      fillRows(k, slice, pixels.reals, voxels, stand, usePadding);
    else
      fillRows(k, slice, pixels.values, voxels, stand, usePadding);
  }

  template <class T, class Stored>
  void fillRows(int k, const SliceHeader& slice, const std::vector<Stored>& stored,
                Volume<T>& voxels, T stand, bool usePadding)
  {
    const PaddingRange<Stored> padding(slice, usePadding);
    const auto columns = static_cast<std::size_t>(slice.columns);
    const auto width = static_cast<std::size_t>(m_box.upper[0] - m_box.lower[0]);
    Stored low = std::numeric_limits<Stored>::max();
    Stored high = std::numeric_limits<Stored>::lowest();
    bool padded = false;
    double rounding = 0.0;
    for (int j = m_box.lower[1]; j < m_box.upper[1]; ++j)
    {
      const Stored* from = stored.data() + static_cast<std::size_t>(j) * columns +
                           static_cast<std::size_t>(m_box.lower[0]);
      T* to = &voxels.at(0, j - m_box.lower[1], k);
      rescaleRow(slice, from, width, to);
      if constexpr (std::is_same_v<T, float>)
        rounding = std::max(rounding, checkRow(slice, from, width, to, padding));
      if (!m_needsRange)
        continue;
      if (padding.empty())
        for (std::size_t i = 0; i < width; ++i)
        {
          low = std::min(low, from[i]);
          high = std::max(high, from[i]);
        }
      else
        for (std::size_t i = 0; i < width; ++i)
        {
          const bool out = padding.contains(from[i]);
          to[i] = out ? stand : to[i];
          padded = padded || out;
          low = out ? low : std::min(low, from[i]);
          high = out ? high : std::max(high, from[i]);
        }
    }

    const std::size_t lastRow = columns * static_cast<std::size_t>(slice.rows - 1);
    bool corner = padded && isBeyondStored(slice);
    for (const std::size_t at : {std::size_t{0}, columns - 1, lastRow, lastRow + columns - 1})
      corner = corner || padding.contains(stored[at]);
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_contents.isPadded = m_contents.isPadded || padded;
    m_contents.cornersPadded = m_contents.cornersPadded || corner;
    m_contents.rounding = std::max(m_contents.rounding, rounding);
    if (low <= high)
    {
      m_contents.real.add(rescaled(slice, low));
      m_contents.real.add(rescaled(slice, high));
    }
  }

  /// By how much values that the file states exactly were rounded. A value that is not finite
  /// would propagate to every sample, picture and force near it.
  template <class Stored>
  static double checkRow(const SliceHeader& slice, const Stored* from, std::size_t count,
                         const float* to, const PaddingRange<Stored>& padding)
  {
    const bool isExact = slice.slope == 1.0 && isWhole(slice.intercept);
    if (!isExact && std::is_integral_v<Stored>)
      return 0.0;
    double worst = 0.0;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (padding.contains(from[i]))
        continue;
      if (!std::isfinite(to[i]))
        throw DicomError(DicomError::Reason::Unsupported,
                         slice.file.filename().string() +
                             " holds values that are not finite numbers (NaN, infinite or beyond "
                             "float); give them the value of what lies outside the scanned field, "
                             "such as -1024 in a CT");
      if (isExact)
        worst = std::max(worst, std::abs(rescaled(slice, static_cast<double>(from[i])) -
                                         static_cast<double>(to[i])));
    }
    return worst;
  }

  template <class T, class Stored>
  static void rescaleRow(const SliceHeader& slice, const Stored* from, std::size_t count, T* to)
  {
    if constexpr (std::is_integral_v<T>)
    {
      const auto slope = static_cast<std::int64_t>(slice.slope);
      const auto intercept = static_cast<std::int64_t>(slice.intercept);
      if (slope == 1)
      {
        // In 16 bits the sum wraps the same way; a value that does not fit ends the attempt anyway.
        const auto offset = static_cast<std::uint16_t>(intercept);
        for (std::size_t i = 0; i < count; ++i)
          to[i] = static_cast<T>(static_cast<std::uint16_t>(
              static_cast<std::uint32_t>(static_cast<std::int64_t>(from[i])) + offset));
      }
      else
        for (std::size_t i = 0; i < count; ++i)
          to[i] = static_cast<T>(slope * static_cast<std::int64_t>(from[i]) + intercept);
    }
    else
      for (std::size_t i = 0; i < count; ++i)
        to[i] = static_cast<T>(slice.slope * static_cast<double>(from[i]) + slice.intercept);
  }

  template <class T>
  static void replace(Volume<T>& voxels, T from, T to)
  {
    T* data = voxels.data();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, voxels.size(), 1 << 20),
                      [=](const auto& range)
                      { std::replace(data + range.begin(), data + range.end(), from, to); });
  }

  void note(std::string text)
  {
    if (m_notes)
      m_notes->push_back(std::move(text));
  }

  const std::vector<SliceHeader>& m_slices;
  const std::string& m_modality;
  GridGeometry m_geometry;
  IndexBox m_box;
  UndeclaredBits m_undeclared;
  const std::function<void(std::size_t)>& m_require;
  const core::Progress& m_progress;
  std::vector<std::string>* m_notes = nullptr;
  std::vector<SignCopies> m_signs;             ///< of each slice; none outside of the box
  std::vector<std::size_t> m_undeclaredPixels; ///< likewise, as each slice tells
  std::optional<const SliceHeader*> m_copies;  ///< copiesOfSign, where it was asked
  bool m_needsRange = true;                    ///< whether the range of the real values is needed
  std::mutex m_mutex;
  Contents m_contents;
};

std::string boxText(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper)
{
  std::string text;
  for (Eigen::Index a = 0; a < 3; ++a)
    text += (a > 0 ? ", " : "") + decimals(lower[a], 1) + " to " + decimals(upper[a], 1);
  return text;
}

IndexBox boxToRead(const GridGeometry& grid, const ReadOptions& options)
{
  if (!options.roi)
    return grid.fullBox();
  const Eigen::Vector3d& lower = options.roi->min();
  const Eigen::Vector3d& upper = options.roi->max();
  const IndexBox box = grid.boxCovering(lower, upper);
  if (!box.empty())
    return box;
  const auto bounds = grid.patientBounds();
  throw DicomError(DicomError::Reason::OutsideRoi, "the box asked for (" + boxText(lower, upper) +
                                                       " mm) does not meet the image (" +
                                                       boxText(bounds.min(), bounds.max()) +
                                                       " mm, patient LPS)");
}

/// Before memory is touched: the system would promise any size and end the program later.
///
/// bytes  of a voxel
void requireMemory(const DicomSeries& series, const GridGeometry& grid, const IndexBox& box,
                   bool isRepaired, const ReadOptions& options, std::size_t bytes)
{
  const std::uint64_t most = options.memory > 0 ? options.memory : core::systemMemory().available;
  const double stack = // which repair reads whole
      isRepaired ? static_cast<double>(bytes * series.geometry.grid->fullBox().count()) : 0.0;
  const double needed = static_cast<double>(bytes * box.count()) + stack;
  if (most == 0 || needed <= static_cast<double>(most))
    return;
  const auto gigabytes = [](double count) { return decimals(1e-9 * count, 1) + " GB"; };
  const auto& dims = grid.dims();
  throw DicomError(DicomError::Reason::TooLarge,
                   "series " + series.uid + ": " + std::to_string(dims[0]) + " x " +
                       std::to_string(dims[1]) + " x " + std::to_string(dims[2]) + " voxels" +
                       (options.roi ? ", of which the region" : "") + " need " + gigabytes(needed) +
                       " of memory, and " + gigabytes(static_cast<double>(most)) + " are free; " +
                       (stack > static_cast<double>(most)
                            ? "repair reads all of it, so close other programs"
                        : options.roi ? "choose a smaller region of it (--roi)"
                                      : "choose a region of it (--roi)"));
}

} // namespace

bool mayFitMemory(const DicomSeries& series, std::uint64_t memory)
{
  if (!series.geometry.grid)
    return true;
  const std::uint64_t most = memory > 0 ? memory : core::systemMemory().available;
  return most == 0 || sizeof(std::int16_t) * series.geometry.grid->fullBox().count() <= most;
}

IntensityVolume readSeries(const DicomSeries& series, const ReadOptions& options,
                           const core::Progress& progress, std::vector<std::string>* notes,
                           volume::ImageProvenance* provenance)
{
  const SeriesGeometry& geometry = series.geometry;
  const bool accepted = geometry.verdict == Verdict::Ok || options.acceptDefects ||
                        (options.repair && geometry.verdict == Verdict::Repairable);
  if (!accepted || !geometry.grid || geometry.slices.empty())
  {
    std::string message = "series " + series.uid + ": ";
    if (geometry.findings.empty())
      message += "it holds no slices that make a volume";
    for (std::size_t i = 0; i < geometry.findings.size(); ++i)
      message += (i > 0 ? " " : "") + std::string(kindName(geometry.findings[i].kind)) + ": " +
                 geometry.findings[i].text;
    throw DicomError(DicomError::Reason::Misleading, message);
  }
  progress.check("reading slices");
  if (geometry.verdict != Verdict::Repairable || options.acceptDefects)
  {
    const IndexBox box = boxToRead(*geometry.grid, options);
    const std::function<void(std::size_t)> require = [&](std::size_t bytes)
    { requireMemory(series, *geometry.grid, box, false, options, bytes); };
    const auto before = interpolatedBefore(geometry, box.lower[2], box.upper[2]);
    if (std::string note = interpolatedBeforeNote(before, box.size()[2]); notes && !note.empty())
      notes->push_back(std::move(note));
    if (provenance)
    {
      *provenance = {};
      provenance->interpolated = before;
      provenance->pixels = pixelFaults(geometry.slices);
    }
    return SeriesReader(series, box, options.undeclaredBits, require, progress).read(notes);
  }
  const SeriesRepair repair(geometry);
  const IndexBox box = boxToRead(repair.grid(), options);
  const std::function<void(std::size_t)> require = [&](std::size_t bytes)
  { requireMemory(series, repair.grid(), box, true, options, bytes); };
  const core::Progress reading = progress.part(0.0, 0.7);
  const IntensityVolume stacked =
      SeriesReader(series, geometry.grid->fullBox(), options.undeclaredBits, require, reading)
          .read(notes);
  if (notes)
    for (std::string& note : repair.notes(box))
      notes->push_back(std::move(note));
  if (provenance)
  {
    *provenance = repair.provenance(box);
    provenance->pixels = pixelFaults(geometry.slices);
  }
  return repair.resample(stacked, box, progress.part(0.7, 1.0));
}

} // namespace petrous::imaging
