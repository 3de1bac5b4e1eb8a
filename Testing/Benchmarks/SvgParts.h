#pragma once

#include <string>
#include <vector>

/// Parts of a plot as SVG text; pixels from the top left.
namespace petrous::cli::svg
{

/// A logarithmic axis for positive values; its ends are of the form 1, 2, 5 x 10^n.
class LogAxis
{
public:
  struct Tick
  {
    double value = 0.0;
    double share = 0.0; ///< position along the axis, 0 to 1
    std::string label;
  };

  /// `values`: to be covered; values <= 0 are drawn at the start.
  explicit LogAxis(const std::vector<double>& values);
  double share(double value) const;
  std::vector<Tick> ticks() const;

private:
  std::vector<double> m_marks; // 1, 2, 5 x 10^n, ascending
};

/// Colour of the n-th program or series.
std::string color(std::size_t n);

std::string text(double x, double y, const std::string& words, const std::string& style = "");
std::string line(double x0, double y0, double x1, double y1, const std::string& stroke = "#ddd");
std::string dot(double x, double y, const std::string& fill, const std::string& hint,
                bool ringed = false);
/// Labels of 10 pixels beside dots, overlapping neither each other nor a dot: a label without space
/// beside its dot is moved, with a leader line, and omitted if there is no space nearby.
class Labels
{
public:
  /// Bounds of the labels.
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
