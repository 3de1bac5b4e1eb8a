#pragma once

#include <string>
#include <vector>

/// Pieces of a plot as SVG text; pixels from the top left.
namespace petrous::cli::svg
{

/// A logarithmic axis over positive values, from one of 1, 2, 5 x 10^n to another.
class LogAxis
{
public:
  struct Tick
  {
    double value = 0.0;
    double share = 0.0; ///< 0 to 1 along the axis
    std::string label;
  };

  /// The values it is to hold; those that are not above 0 stand at its start.
  explicit LogAxis(const std::vector<double>& values);
  double share(double value) const;
  std::vector<Tick> ticks() const;

private:
  std::vector<double> m_marks; // 1, 2, 5 x 10^n, rising
};

/// A colour for the n-th of several programs or series.
std::string color(std::size_t n);

std::string text(double x, double y, const std::string& words, const std::string& style = "");
std::string line(double x0, double y0, double x1, double y1, const std::string& stroke = "#ddd");
std::string dot(double x, double y, const std::string& fill, const std::string& hint,
                bool ringed = false);
/// Numbers beside dots, in 10 pixels, none over another or over a dot: where there is no room
/// beside its dot one is moved, with a thin line to it, and where there is none near it is left
/// out.
class Labels
{
public:
  /// The rectangle that they keep to.
  Labels(double left, double top, double right, double bottom);
  void keepClear(double x, double y, double radius);
  std::string beside(double x, double y, const std::string& words);

private:
  struct Box
  {
    double left, top, right, bottom;
  };
  bool free(const Box& box) const;

  Box m_within;
  std::vector<Box> m_taken;
};

std::string start(double width, double height, const std::string& title);

} // namespace petrous::cli::svg
