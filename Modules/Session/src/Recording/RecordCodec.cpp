#include "RecordCodec.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include <Eigen/Dense>

#include "WordPlanes.h"

namespace petrous::session
{

namespace
{

constexpr std::size_t kColumns = sizeof(TickRecord) / 8;
constexpr std::size_t kMaxSources = 8;

using Table = std::array<Words, kColumns>;

enum Rule : std::uint8_t
{
  kPrevious, // value of the previous tick
  kLine,     // 2 x[t-1] - x[t-2]
  kCopy,     // value of the first source in the same tick
  kFit,      // x[t-1] + sum_j g_j (y_j[t] - y_j[t-1]), y_j the sources
  kRules
};

struct Column
{
  bool real = true; // doubles; others are predicted by kPrevious only
  std::size_t sourceCount = 0;
  std::array<std::uint8_t, kMaxSources> sources{};
};

class Layout
{
public:
  Layout()
  {
    for (const std::size_t at :
         {offsetof(TickRecord, number), offsetof(TickRecord, input) + offsetof(TickInput, buttons),
          parameter(offsetof(ServoParameters, clutchButtons)),
          parameter(offsetof(ServoParameters, clutch)), offsetof(TickRecord, maskState),
          offsetof(TickRecord, contacts)})
      m_columns[at / 8].real = false;

    const std::size_t device = offsetof(TickRecord, input) + offsetof(TickInput, device);
    const std::size_t mapped = offsetof(TickRecord, mapped);
    const std::size_t proxy = offsetof(TickRecord, proxy);
    const std::size_t wrench = offsetof(TickRecord, wrench);
    const std::size_t output = offsetof(TickRecord, output);
    const std::size_t burr = offsetof(TickRecord, burrForce);
    constexpr std::size_t turn = offsetof(PoseValues, rotation);
    constexpr std::size_t torque = offsetof(WrenchValues, torque);
    explain(offsetof(TickRecord, input) + offsetof(TickInput, time), 1,
            {{offsetof(TickRecord, input) + offsetof(TickInput, now), 1}});
    explain(mapped, 3, {{device, 3}});
    explain(mapped + turn, 4, {{device + turn, 4}});
    explain(proxy, 3, {{mapped, 3}});
    explain(proxy + turn, 4, {{mapped + turn, 4}});
    explain(wrench, 3, {{mapped, 3}, {proxy, 3}});
    explain(wrench + torque, 3, {{mapped + turn, 4}, {proxy + turn, 4}});
    explain(output, 3, {{wrench, 3}});
    explain(output + torque, 3, {{wrench + torque, 3}});
    explain(offsetof(TickRecord, thrust), 1, {{wrench, 3}});
    explain(burr, 3, {{wrench, 3}});
    explain(offsetof(TickRecord, contactRadius), 1, {{proxy + turn, 4}, {burr, 3}});
    explain(offsetof(TickRecord, elevation), 1, {{proxy + turn, 4}, {burr, 3}});
  }

  const Column& operator[](std::size_t column) const { return m_columns[column]; }

private:
  struct Span
  {
    std::size_t offset;
    std::size_t count;
  };
  static std::size_t parameter(std::size_t offset)
  {
    return offsetof(TickRecord, input) + offsetof(TickInput, parameters) + offset;
  }
  // The first source of each column is its counterpart in the first span.
  void explain(std::size_t offset, std::size_t count, std::initializer_list<Span> spans)
  {
    for (std::size_t n = 0; n < count; ++n)
    {
      Column& column = m_columns[offset / 8 + n];
      for (const Span& span : spans)
        for (std::size_t s = 0; s < span.count; ++s)
          column.sources[column.sourceCount++] = static_cast<std::uint8_t>(span.offset / 8 + s);
      if (n < spans.begin()->count)
        std::swap(column.sources[0], column.sources[n]);
    }
  }
  std::array<Column, kColumns> m_columns{};
};

const Layout& layout()
{
  static const Layout instance;
  return instance;
}

double realOf(std::uint64_t word)
{
  double value;
  std::memcpy(&value, &word, sizeof value);
  return value;
}

std::uint64_t bitsOf(double value)
{
  std::uint64_t word;
  std::memcpy(&word, &value, sizeof word);
  return word;
}

using Gains = std::array<double, kMaxSources>;

// Bit-identical on every machine: one rounding per operation (2 x is exact, fma rounds once).
std::uint64_t predict(Rule rule, const Table& table, std::size_t c, std::size_t t,
                      const Gains& gains)
{
  const Words& own = table[c];
  const Column& column = layout()[c];
  if (rule == kCopy)
    return table[column.sources[0]][t];
  if (t == 0)
    return 0;
  const std::uint64_t previous = own[t - 1];
  double value = realOf(previous);
  if (rule == kLine && t > 1)
    value = 2.0 * value - realOf(own[t - 2]);
  else if (rule == kFit)
    for (std::size_t s = 0; s < column.sourceCount; ++s)
    {
      const Words& source = table[column.sources[s]];
      value = std::fma(gains[s], realOf(source[t]) - realOf(source[t - 1]), value);
    }
  else
    return previous;
  // NaN, infinity and subnormals may differ between machines.
  return std::isnormal(value) ? bitsOf(value) : previous;
}

// Least-squares gains over the block, on the values themselves, as their differences are rounded
// too coarsely. Zeros if a value is not finite.
Gains fit(const Table& table, std::size_t c)
{
  const Column& column = layout()[c];
  const auto rows = static_cast<Eigen::Index>(table[c].size());
  Eigen::MatrixXd sources(rows, static_cast<Eigen::Index>(column.sourceCount));
  Eigen::VectorXd own(rows);
  for (Eigen::Index t = 0; t < rows; ++t)
  {
    own[t] = realOf(table[c][static_cast<std::size_t>(t)]);
    for (Eigen::Index s = 0; s < sources.cols(); ++s)
      sources(t, s) =
          realOf(table[column.sources[static_cast<std::size_t>(s)]][static_cast<std::size_t>(t)]);
  }
  Gains gains{};
  if (!own.allFinite() || !sources.allFinite())
    return gains;
  own.array() -= own.mean();
  const Eigen::RowVectorXd mean = sources.colwise().mean();
  sources.rowwise() -= mean;
  const Eigen::VectorXd solution = sources.colPivHouseholderQr().solve(own);
  if (solution.allFinite())
    for (Eigen::Index s = 0; s < sources.cols(); ++s)
      gains[static_cast<std::size_t>(s)] = solution[s];
  return gains;
}

Words residuals(Rule rule, const Table& table, std::size_t c, const Gains& gains)
{
  Words codes(table[c].size());
  for (std::size_t t = 0; t < codes.size(); ++t)
    codes[t] = codeOf(table[c][t], predict(rule, table, c, t, gains));
  return codes;
}

std::size_t costOf(const Words& codes)
{
  std::size_t cost = 0;
  for (const std::uint64_t code : codes)
    cost += static_cast<std::size_t>(bytesOf(code));
  return cost;
}

} // namespace

std::size_t maxBytes(std::size_t count)
{
  return kColumns * (2 + 8 * kMaxSources + 8 * count);
}

std::vector<std::uint8_t> encodeTicks(const std::vector<TickRecord>& ticks)
{
  Table table;
  for (std::size_t c = 0; c < kColumns; ++c)
    table[c].resize(ticks.size());
  for (std::size_t t = 0; t < ticks.size(); ++t)
    for (std::size_t c = 0; c < kColumns; ++c)
      std::memcpy(&table[c][t], reinterpret_cast<const char*>(&ticks[t]) + 8 * c, 8);

  std::vector<std::uint8_t> bytes;
  for (std::size_t c = 0; c < kColumns; ++c)
  {
    const Column& column = layout()[c];
    Rule best = kPrevious;
    Gains gains{};
    Words codes = residuals(kPrevious, table, c, gains);
    std::size_t cost = costOf(codes);
    for (int r = kLine; r < kRules && cost > 0 && column.real; ++r)
    {
      const Rule rule = static_cast<Rule>(r);
      if (rule != kLine && column.sourceCount == 0)
        continue;
      const Gains tried = rule == kFit ? fit(table, c) : Gains{};
      Words other = residuals(rule, table, c, tried);
      const std::size_t price = costOf(other) + (rule == kFit ? 8 * column.sourceCount : 0);
      if (price >= cost)
        continue;
      best = rule;
      cost = price;
      gains = tried;
      codes = std::move(other);
    }
    const int planes = planesOf(codes);
    bytes.push_back(best);
    bytes.push_back(static_cast<std::uint8_t>(planes));
    for (std::size_t s = 0; best == kFit && s < column.sourceCount; ++s)
      for (int byte = 0; byte < 8; ++byte)
        bytes.push_back(static_cast<std::uint8_t>(bitsOf(gains[s]) >> (8 * byte)));
    putPlanes(codes, planes, bytes);
  }
  return bytes;
}

bool decodeTicks(const std::vector<std::uint8_t>& bytes, std::size_t count,
                 std::vector<TickRecord>& ticks)
{
  Table table;
  std::size_t at = 0;
  const auto left = [&] { return bytes.size() - at; };
  for (std::size_t c = 0; c < kColumns; ++c)
  {
    const Column& column = layout()[c];
    if (left() < 2)
      return false;
    const auto rule = static_cast<Rule>(bytes[at]);
    const std::size_t planes = bytes[at + 1];
    at += 2;
    const bool asked = rule == kCopy || rule == kFit;
    if (rule >= kRules || planes > 8 || (asked && column.sourceCount == 0))
      return false;
    Gains gains{};
    if (rule == kFit)
    {
      if (left() < 8 * column.sourceCount)
        return false;
      for (std::size_t s = 0; s < column.sourceCount; ++s)
      {
        std::uint64_t word = 0;
        for (int byte = 0; byte < 8; ++byte)
          word |= static_cast<std::uint64_t>(bytes[at++]) << (8 * byte);
        gains[s] = realOf(word);
      }
    }
    if (left() < planes * count)
      return false;
    Words& own = table[c];
    own.resize(count);
    for (std::size_t t = 0; t < count; ++t)
      own[t] =
          wordOf(codeAt(bytes.data() + at, planes, count, t), predict(rule, table, c, t, gains));
    at += planes * count;
  }
  if (left() != 0)
    return false;
  ticks.resize(count);
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t c = 0; c < kColumns; ++c)
      std::memcpy(reinterpret_cast<char*>(&ticks[t]) + 8 * c, &table[c][t], 8);
  return true;
}

} // namespace petrous::session
