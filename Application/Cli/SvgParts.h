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
std::string start(double width, double height, const std::string& title);

} // namespace petrous::cli::svg
