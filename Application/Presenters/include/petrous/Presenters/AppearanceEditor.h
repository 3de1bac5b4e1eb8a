#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Appearance/OwnPresets.h"
#include "petrous/Presenters/AppearanceHistograms.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::presenters
{

/// The opacity axis of a plot, 0 to 1 of its height: logarithmic from kLeast to 1, linear from 0 to
/// kLeast, so that no opacity at all is on it too.
///
///   h(o) = b o / l                          0 <= o <= l
///   h(o) = b + (1 - b) (1 - lg o / lg l)    l <= o <= 1
///
/// o   opacity of 1 mm;  l   kLeast;  b   kBand
struct OpacityAxis
{
  static constexpr double kLeast = 0.001;
  static constexpr double kBand = 0.08;

  static double height(double opacity) noexcept;  ///< clamped to 0 to 1
  static double opacity(double height) noexcept;  ///< the inverse; likewise
  static double rounded(double opacity) noexcept; ///< to three significant digits, at most 4 places
};

/// Edits the transfer functions of the open case [Chan2016, Fig. 10]: of bone, of soft tissue and
/// of each structure of a label map, in the values of the image that it reads. A change is one
/// WorkstationModel::setLook; none while drilling. Without Qt; not thread-safe.
class AppearanceEditor
{
public:
  static constexpr const char* kBone = "ct"; ///< as `petrous appearance` calls it
  static constexpr const char* kSoftTissue = scene::kSoftTissue;

  /// What has a transfer function.
  struct Part
  {
    std::string name; ///< kBone: bone, or the tissue of an MR as primary image; kSoftTissue
    appearance::StructureAppearance look;
    /// In the values of the image that it reads; empty: drawn in one colour.
    std::vector<appearance::ControlPoint> points;
    /// What its points do: `points`, or one colour at every value.
    appearance::TransferFunction transfer = appearance::TransferFunction::constant({}, 0.0F);
  };

  struct Source
  {
    std::string name; ///< of an MR; empty: the primary image
    bool registered = true;
  };

  struct Preset
  {
    appearance::StructureAppearance look;
    bool isOwn = false; ///< of the library, can be deleted
  };

  /// The values of the image that the selected part reads.
  struct Axis
  {
    double least = 0.0; ///< reaches over what is offered and all points on it
    double most = 1.0;
    std::string image; ///< "CT", "T2"
    std::string unit;  ///< "HU"; empty: none
    int decimals = 0;  ///< of numbers that are entered
    double step = 1.0; ///< of an arrow key
    double gap = 1.0;  ///< least distance of two points
    std::string number(double value) const;
    std::string text(double value) const; ///< with the unit
    double rounded(double value) const;
  };

  explicit AppearanceEditor(WorkstationModel& model);

  /// Takes over the case and its looks as they are; call when they changed.
  void refresh();
  /// A part has another name; before `refresh`. One that is selected stays so, with its point.
  void renamed(const std::string& from, const std::string& to);

  const std::vector<Part>& parts() const noexcept { return m_parts; } ///< bone, soft tissue
  const Part* selected() const noexcept;                              ///< nullptr: there is no case
  void select(const std::string& part); ///< no effect if there is none
  void selectNext(int step);            ///< the next one on the same axis, in a circle
  std::optional<std::size_t> point() const noexcept { return m_point; } ///< selected
  void selectPoint(std::optional<std::size_t> point);
  /// Those that read the same image as the selected one and are shown, and that one.
  std::vector<const Part*> onAxis() const;
  Axis axis() const;

  /// Adds a point and selects it; colour and specular are those that were there. Without an opacity
  /// this too. Selects the point that is there already. Returns false if nothing was added.
  bool addPoint(double value, std::optional<double> opacity = {});
  /// Halfway to the next point, or beyond the last one.
  bool addPointAfterSelected();
  /// The selected point; its value stays between its neighbours and is rounded as numbers are
  /// entered, unless it stays.
  void setPoint(const appearance::ControlPoint& point);
  void removePoint(); ///< the selected one; without the last the part is drawn in one colour

  /// Of the selected point, or else of the part, whose points keep their shades.
  void setColor(const std::array<float, 3>& color);
  std::array<float, 3> color() const;

  /// Of the surface, 0 to 1; of a lumen, how much it tints bone; of soft tissue, a factor of that
  /// of its function. Below 1 the inside is seen.
  void setSurfaceOpacity(double opacity);

  /// The built-in ones, then those of the library. Throws as OwnPresets::all.
  std::vector<Preset> presets() const;
  bool canHave(const Preset& preset) const; ///< the selected part; false: none is selected
  /// As `petrous appearance --set`. Throws as presetFor and withPreset.
  void applyPreset(const std::string& name);
  void savePreset(const std::string& name);   ///< the part's appearance; throws as OwnPresets::save
  void deletePreset(const std::string& name); ///< throws as OwnPresets::remove
  /// To the preset that the part has, its colour where that leaves it open. Throws as applyPreset.
  void reset();

  std::string json() const; ///< as `petrous appearance --tf` reads it
  /// Throws as TransferFunction::fromJson.
  void setJson(const std::string& text);
  void clearPoints(); ///< one colour at every value

  std::vector<Source> sources() const; ///< the primary image first
  /// Why the selected part reads the primary image only; empty: it may read any.
  std::string sourceFixed() const;
  /// Soft tissue gets a function of an MR's values with it. Throws as softTissueReading.
  void setSource(const std::string& image);
  /// Why the selected part is drawn in one colour although it has a function, or soft tissue not at
  /// all; empty: it is drawn as it is set.
  std::string notice() const;
  std::string estimate() const; ///< softTissueEstimate, while soft tissue is selected

  /// Whether `fit` has what it needs.
  bool canFit() const;
  /// Moves the points so that the first and the last lie where the image has most of the part's
  /// values (2nd and 98th percentile; of bone, of the values above the threshold), the others in
  /// proportion. Without points, gives it two shades of its colour. Soft tissue of an MR gets the
  /// function with which it begins; that of a CT has values in Hounsfield units, and is not fitted.
  void fit();

  AppearanceHistograms::Histogram imageHistogram() const; ///< that the selected part reads
  AppearanceHistograms::Histogram
  insideHistogram() const; ///< within it; bone, soft tissue: nullptr
  bool counts() const noexcept { return m_isCounting; }
  /// Counts missing histograms, in any thread; then call `counted`. Empty: none, or under way.
  std::function<AppearanceHistograms(const core::Progress&)> beginCounting();
  /// `of`: WorkstationModel::shownAs when it began. Without effect after another case was opened.
  void counted(AppearanceHistograms done, std::uint64_t of);
  void notCounted();
  void dropHistograms();

private:
  void set(const appearance::StructureAppearance& look);
  void setPoints(std::vector<appearance::ControlPoint> points);

  WorkstationModel& m_model;
  std::vector<Part> m_parts;
  std::size_t m_selected = 0;  // of m_parts
  std::uint64_t m_shownAs = 0; // WorkstationModel's
  std::optional<std::size_t> m_point;
  AppearanceHistograms m_histograms;
  bool m_isCounting = false;
};

/// The look of a case's soft tissue with another image as its source: the values of one mean
/// nothing in another, so that it gets the function of appearance::softTissueOfMr, or that of the
/// default for the primary image (empty). Throws InvalidParameter if there is no such MR, and what
/// reading it throws. `histogram`: of the MR; nullptr: it is counted.
appearance::StructureAppearance softTissueReading(const scene::Case& value,
                                                  const std::string& image,
                                                  AppearanceHistograms::Histogram histogram = {});

/// Whether a preset can be the look of the part: bone and soft tissue are no lumens.
bool canBeLookOf(const scene::Case& value, const std::string& part,
                 const appearance::StructureAppearance& preset);

/// The preset of this name for the part. Throws as OwnPresets::preset, listing those that can be
/// its look.
appearance::StructureAppearance presetFor(const scene::Case& value, const std::string& part,
                                          const appearance::OwnPresets& presets,
                                          const std::string& name);

/// A part's look with a preset; where that leaves the colour open ("other"), with one unlike those
/// of the other parts. Throws InvalidParameter if bone or soft tissue would become a lumen, or if
/// the preset has values of an MR and the part reads a CT, or the other way round; soft tissue
/// reads the CT with a preset for it.
appearance::StructureAppearance withPreset(const scene::Case& value, const std::string& part,
                                           const appearance::StructureAppearance& preset);

/// A look fitted to the histogram of the image that it reads, within it: see AppearanceEditor::fit.
/// `above`: only these values count. Throws InvalidParameter if the histogram has none.
appearance::StructureAppearance fitted(const appearance::StructureAppearance& look,
                                       const volume::IntensityScale& scale,
                                       const volume::IntensityHistogram& histogram,
                                       std::optional<double> above = {});

/// The same for a part of a case, kBone for bone, kSoftTissue for soft tissue, whose histogram is
/// counted first. Throws as well if the part has no values: a mesh, a lumen; or if it is soft
/// tissue of a CT.
appearance::StructureAppearance fitted(const scene::Case& value, const std::string& part,
                                       const core::Progress& progress = {});

} // namespace petrous::presenters
