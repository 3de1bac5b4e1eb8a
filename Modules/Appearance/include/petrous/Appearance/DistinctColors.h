#pragma once

#include <array>
#include <vector>

namespace petrous::appearance
{

/// Colours for structures whose names match no preset: of a palette of 64 each time the one
/// farthest from all that are taken, from bone, black, grey, and from the colours of nerves,
/// arteries and veins; where those are used up, of a grid in steps of 1/8, and then each colour is
/// given again, none oftener than the others by more than one. Deterministic; one colour costs as
/// many comparisons as are offered, whatever is taken.
///
/// The distance of two colours is the minimum over four kinds of vision: normal, and without long,
/// middle or short wavelength cones (protan, deutan, tritan: matrices of severity 1 in Machado,
/// Oliveira and Fernandes, IEEE Trans. Visualization and Computer Graphics 15(6), 2009, doi
/// 10.1109/TVCG.2009.113). Each is CIEDE2000 (ISO/CIE 11664-6), weighted 1 for normal vision
/// and 1.4 for the others, our choice, so that it is larger for normal vision. Between any two of
/// the first 12, 24 and 60 it is at least 14.8, 10.3 and 6.4 for normal vision, and 9.5, 6.5
/// and 4.1 for the others, also by the model of Vienot, Brettel and Mollon (1999).
///
/// Colours are sRGB, 0 to 1.
class DistinctColors
{
public:
  using Color = std::array<float, 3>;
  using Seen = std::array<std::array<double, 3>, 4>; ///< CIE L*a*b*, by each kind of vision

  explicit DistinctColors(const std::vector<Color>& taken = {});

  void take(const Color& color);
  Color next(); ///< takes it

private:
  struct Offered
  {
    Color color;
    Seen sights;
    double nearest; // weighted CIEDE2000, to the nearest of those taken
    int given = 0;
  };
  void offer(const Color& color);

  std::vector<Seen> m_taken;
  std::vector<Offered> m_offered;
  bool m_hasGrid = false;
};

} // namespace petrous::appearance
