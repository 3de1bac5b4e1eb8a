#include <limits>
#include <type_traits>

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "petrous/Appearance/AppearanceMaterial.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/HistoryText.h"
#include "petrous/Scene/Manifest.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

core::RigidSpread someSpread()
{
  core::RigidSpread::Moments root = core::RigidSpread::Moments::Identity() / 3.0;
  root(4, 1) = -0.1;
  root(5, 0) = 0.2;
  return {{1.0 / 7.0, 2.0, -3.0}, root * root.transpose()};
}

scene::Case fullCase()
{
  scene::Case value;
  value.name = "Ohr links ü";
  value.revision = 41;
  value.iso = 287.123456789012345;
  value.denseBone = 21034.7;
  value.softTissueValues = {4211.3, 14560.7};
  value.boneLook.opacity = 0.3F;
  value.boneLook.shown = false;
  value.ct.name = "ct";
  value.ct.object = "abc.nrrd";
  value.ct.geometry = core::GridGeometry({512, 512, 166}, {1.0 / 3.0, 0.45, 0.7000000001},
                                         {-123.456789, 0.1, 1e-7});
  value.ct.range = {-1024, 3617};
  value.ct.notes = {"jitter of 0.02 mm"};
  scene::ImagePart mr = value.ct;
  mr.name = "t2";
  mr.registered = true;
  mr.mrFromCt = {Eigen::Quaterniond(0.9, 0.1, 0.2, 0.3), {1, 2, 3}};
  mr.frameOfReference = std::string(64, 'a');
  scene::Registration how;
  how.method = scene::Registration::Method::FrameOfReference;
  how.refined = true;
  how.verdict = scene::Registration::Verdict::Good;
  how.text = "alle Starts enden am selben Ort";
  how.metric = 1.0 / 3.0;
  how.error = scene::RegistrationError{{1.0 / 7.0, 2.0, -3.0}, "incus", 0.1, 0.2, 0.3};
  how.error->spread = someSpread();
  how.through = "flair";
  how.signOff = scene::SignOff{"A. Chirurgin ü", "2026-01-02T03:04:05Z", mr.mrFromCt};
  mr.registration = how;
  value.mr = {mr};
  scene::LabelPart part;
  part.object = "def.seg.nrrd";
  scene::StructurePart s;
  s.name = "nerve";
  s.index = 300;
  s.voxels = 123456789012ULL;
  s.volume = 0.1;
  s.look.color = {0.1F, 0.2F, 0.3F};
  s.look.touchable = false;
  s.look.transfer = appearance::TransferFunction({{-100.5, {0.1F, 1.0F / 3.0F, 0.7F}, 0.2F, 0.9F},
                                                  {1.0 / 3.0, {1.0F, 0.0F, 0.5F}, 1.0F, 0.0F}});
  s.look.sourceImage = "t2";
  s.look.shininess = 47.5F;
  s.look.priority = 3;
  s.look.stiffness = 0.35;
  s.look.warning = 1.25;
  part.structures = {s};
  value.labels = {part};
  scene::MeshPart mesh;
  mesh.name = "incus";
  mesh.object = "ghi.obj";
  mesh.triangles = 12;
  value.meshes = {mesh};
  core::CameraPose camera;
  camera.parallelScale = 33.0;
  value.camera = camera;
  dissection::Stroke stroke;
  stroke.object = "jkl.stroke";
  stroke.bytes = 1234;
  stroke.info.startedAt = "2026-01-01T00:00:00Z";
  stroke.info.burr.kind = dissection::Burr::Kind::Diamond;
  stroke.info.removed = 1.0 / 7.0;
  stroke.info.structures = {{"nerve", 0.25}};
  stroke.info.camera = core::CameraPose{};
  stroke.info.recovered = true;
  auto history = dissection::History::line(1, 1);
  history.start("zweiter Zugang ü", 0);
  history.add();
  history.add();
  history.undo();
  const auto listed = std::make_shared<const dissection::Stroke>(stroke);
  value.dissection = dissection::Dissection({listed, listed, listed}, history);
  return value;
}

} // namespace

TEST(Manifest, ComesBackAsItWent)
{
  const scene::Case value = fullCase();
  const std::string text = scene::toManifest(value);
  const scene::Case back = scene::fromManifest(text, "m.json");
  EXPECT_EQ(scene::toManifest(back), text);
  EXPECT_EQ(back.iso, value.iso);
  EXPECT_EQ(back.ct.geometry.spacing(), value.ct.geometry.spacing());
  EXPECT_EQ(back.ct.geometry.origin(), value.ct.geometry.origin());
  EXPECT_EQ(back.dissection.strokes()[0]->info.removed, 1.0 / 7.0);
  EXPECT_FALSE(back.labels[0].structures[0].look.touchable);
  EXPECT_EQ(back.labels[0].structures[0].voxels, 123456789012ULL);
  EXPECT_LT((back.mr[0].mrFromCt.matrix() - value.mr[0].mrFromCt.matrix()).norm(), 1e-15);
}

TEST(Manifest, KeepsHowAnMrWasRegistered)
{
  const scene::Case back = scene::fromManifest(scene::toManifest(fullCase()), "m.json");
  const scene::ImagePart& mr = back.mr[0];
  EXPECT_EQ(mr.frameOfReference, std::string(64, 'a'));
  ASSERT_TRUE(mr.registration && mr.registration->error);
  EXPECT_EQ(mr.registration->method, scene::Registration::Method::FrameOfReference);
  EXPECT_TRUE(mr.registration->refined);
  EXPECT_EQ(mr.registration->verdict, scene::Registration::Verdict::Good);
  EXPECT_EQ(mr.registration->text, "alle Starts enden am selben Ort");
  EXPECT_EQ(mr.registration->metric, 1.0 / 3.0);
  EXPECT_EQ(mr.registration->error->point, Vector3d(1.0 / 7.0, 2.0, -3.0));
  EXPECT_EQ(mr.registration->error->place, "incus");
  EXPECT_EQ(mr.registration->error->p95, 0.2);
  ASSERT_TRUE(mr.registration->error->spread);
  EXPECT_TRUE(*mr.registration->error->spread == someSpread());
  auto older = nlohmann::json::parse(scene::toManifest(fullCase()));
  older["mr"][0]["registration"]["error"].erase("spread");
  EXPECT_FALSE(scene::fromManifest(older.dump(), "m.json").mr[0].registration->error->spread);
  EXPECT_EQ(mr.registration->through, "flair");
  ASSERT_TRUE(scene::validSignOff(mr));
  EXPECT_EQ(scene::validSignOff(mr)->who, "A. Chirurgin ü");
}

TEST(Manifest, KeepsThePatientOnlyAsSaltedHashes)
{
  scene::Case value = fullCase();
  value.ct.patient = {"i", "j", "n", "b", {"p", "q"}};
  value.ct.isFrameSalted = false;
  EXPECT_EQ(scene::toManifest(value).find("patient_"), std::string::npos);
  scene::saltIdentity(value.ct, [](const std::string& hash) { return hash + "1"; });
  scene::saltIdentity(value.ct, [](const std::string& hash) { return hash + "2"; }); // once
  const scene::Case back = scene::fromManifest(scene::toManifest(value), "m.json");
  EXPECT_EQ(back.ct.patient.id, "i1");
  EXPECT_EQ(back.ct.patient.issuer, "j1");
  EXPECT_EQ(back.ct.patient.name, "n1");
  EXPECT_EQ(back.ct.patient.birthDate, "b1");
  EXPECT_EQ(back.ct.patient.nameParts, (std::vector<std::string>{"p1", "q1"}));
  EXPECT_TRUE(back.ct.isFrameSalted);
  EXPECT_TRUE(back.mr[0].patient.empty());
  EXPECT_EQ(scene::toManifest(back), scene::toManifest(value));
}

// The second format stated that an MR is registered, but not how.
TEST(Manifest, OpensOneWithoutRecordsOfRegistration)
{
  auto j = nlohmann::json::parse(scene::toManifest(fullCase()));
  j["petrous_case"] = 2;
  j["mr"][0].erase("registration");
  j["mr"][0].erase("frame_of_reference_sha256");
  const scene::Case back = scene::fromManifest(j.dump(), "m.json");
  EXPECT_TRUE(back.mr[0].registered);
  EXPECT_FALSE(back.mr[0].registration);
  EXPECT_FALSE(scene::validSignOff(back.mr[0]));
  EXPECT_EQ(back.mr[0].frameOfReference, "");
}

TEST(Manifest, RefusesARecordOfRegistrationThatIsNone)
{
  const auto good = nlohmann::json::parse(scene::toManifest(fullCase()));
  const auto refused = [&good](const char* pointer, const nlohmann::json& bad)
  {
    auto j = good;
    j[nlohmann::json::json_pointer(std::string("/mr/0/registration") + pointer)] = bad;
    EXPECT_THROW(scene::fromManifest(j.dump(), "m.json"), scene::ManifestError) << pointer << bad;
  };
  refused("/method", "magic");
  refused("/verdict", "failed");
  refused("/error/p95_mm", -0.05);
  refused("/error/median_mm", -0.1);
  refused("/error/spread/moments_mm_rad/0", -0.1);
  refused("/error/spread/moments_mm_rad/1", 1e3); // more than both of its axes have
  refused("/error/spread/moments_mm_rad", {1.0, 2.0});
  refused("/error/spread", nlohmann::json::object());
  refused("/signed_off/mr_from_ct", nullptr);
}

TEST(Manifest, KeepsLooksToTheLastBit)
{
  const scene::Case value = fullCase();
  const scene::Case back = scene::fromManifest(scene::toManifest(value), "m.json");
  const auto& look = back.labels[0].structures[0].look;
  EXPECT_EQ(look.transfer, value.labels[0].structures[0].look.transfer);
  EXPECT_FALSE(look.relative);
  EXPECT_EQ(look.sourceImage, "t2");
  EXPECT_EQ(look.shininess, 47.5F);
  EXPECT_EQ(look.priority, 3);
  EXPECT_EQ(look.stiffness, 0.35);
  EXPECT_EQ(back.meshes[0].look.stiffness, 0.0);
  EXPECT_EQ(look.warning, 1.25);
  EXPECT_EQ(back.denseBone, 21034.7);
  ASSERT_TRUE(back.softTissueValues);
  EXPECT_EQ(back.softTissueValues->foot, 4211.3);
  EXPECT_EQ(back.softTissueValues->peak, 14560.7);
  EXPECT_EQ(back.boneLook.transfer, value.boneLook.transfer);
  EXPECT_TRUE(back.boneLook.relative);
  EXPECT_EQ(back.boneLook.opacity, 0.3F);
  EXPECT_FALSE(back.boneLook.shown);
  EXPECT_FALSE(back.meshes[0].look.transfer.has_value());
}

namespace
{

using appearance::StructureAppearance;
using appearance::StructureProperty;

/// Gives `property` a value that is neither its default nor that of the preset.
void setAnother(StructureAppearance& look, const StructureProperty& property)
{
  std::visit(
      [&](auto member)
      {
        auto& value = look.*member;
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, bool>)
          value = !value;
        else if constexpr (std::is_arithmetic_v<T>)
          value = static_cast<T>(0.3 * property.range.lower + 0.7 * property.range.upper);
        else if constexpr (std::is_same_v<T, std::string>)
          value = "änother";
        else if constexpr (std::is_same_v<T, std::array<float, 3>>)
          value = {0.1F, 1.0F / 3.0F, 0.7F};
        else
          value = appearance::TransferFunction::constant({0.1F, 0.2F, 0.3F}, 0.4F, 0.5F);
      },
      property.member);
}

std::string refusalOf(const nlohmann::json& manifest)
{
  try
  {
    scene::fromManifest(manifest.dump(), "m.json");
    return {};
  }
  catch (const scene::ManifestError& error)
  {
    EXPECT_EQ(error.reason, scene::ManifestError::Reason::Damaged);
    return error.what();
  }
}

} // namespace

TEST(Manifest, KeepsEachPropertyOfAStructure)
{
  for (const StructureProperty& property : appearance::kStructureProperties)
  {
    scene::Case value = fullCase();
    auto& look = value.labels[0].structures[0].look;
    look = {};
    const auto before = appearance::valueJson(look, property);
    setAnother(look, property);
    ASSERT_NE(appearance::valueJson(look, property), before) << property.key;
    const std::string text = scene::toManifest(value);
    const scene::Case back = scene::fromManifest(text, "m.json");
    const auto& read = back.labels[0].structures[0].look;
    std::visit([&](auto member) { EXPECT_TRUE(read.*member == look.*member) << property.key; },
               property.member);
    EXPECT_EQ(scene::toManifest(back), text) << property.key;
  }
}

TEST(Manifest, RefusesANumberOfAStructureThatIsOutOfItsRange)
{
  const auto good = nlohmann::json::parse(scene::toManifest(fullCase()));
  for (const StructureProperty& property : appearance::kStructureProperties)
  {
    const bool isColor = std::holds_alternative<StructureProperty::Color>(property.member);
    if (!property.isNumber() && !isColor)
      continue;
    const nlohmann::json::json_pointer place("/labels/0/structures/0/look/" +
                                             std::string(property.key) + (isColor ? "/1" : ""));
    for (const double wrong : {property.range.lower - 1.0, property.range.upper + 0.1})
    {
      auto j = good;
      j[place] = wrong;
      const std::string text = refusalOf(j);
      EXPECT_NE(text.find(std::string(property.key) + ": must lie within " + property.range.text()),
                std::string::npos)
          << property.key << ": " << text;
    }
    auto j = good;
    j[place] = nullptr; // how JSON writes NaN
    EXPECT_FALSE(refusalOf(j).empty()) << property.key;
    scene::Case value = fullCase();
    auto& look = value.labels[0].structures[0].look;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (isColor)
      look.color[1] = static_cast<float>(nan);
    else
      EXPECT_THROW(appearance::setNumber(look, property, nan), core::InvalidParameter);
    if (const auto* real = std::get_if<double StructureAppearance::*>(&property.member))
      look.*(*real) = nan;
    else if (const auto* single = std::get_if<float StructureAppearance::*>(&property.member))
      look.*(*single) = static_cast<float>(nan);
    else if (!isColor)
      continue; // an integer is never NaN
    EXPECT_THROW(scene::toManifest(value), core::InvalidParameter) << property.key;
  }
}

TEST(Manifest, RefusesANumberOfTheViewThatIsOutOfItsRangeAndNamesIt)
{
  using nlohmann::json;
  scene::Case value = fullCase();
  value.camera = core::CameraPose{};
  auto& other = value.view.branches["zweiter Zugang ü"];
  other.camera.emplace();
  other.camera->parallelScale = 12.0;
  value.view.slices.emplace();
  value.view.slices->width = 4000.0;
  value.view.slices->planes.emplace();
  value.view.light.emplace();
  value.view.stereo.emplace();
  value.view.stereo->eyeSeparation = 12.0;
  value.view.stereo->convergence = 300.0;
  value.view.clipping.planes = {{{1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}}};
  value.view.saved["Nische"].camera = core::CameraPose{};
  const json good = json::parse(scene::toManifest(value));
  EXPECT_TRUE(scene::fromManifest(good.dump(), "m").camera);
  const auto refused = [&good](const std::string& place, const json& wrong, const char* words)
  {
    json j = good;
    const json::json_pointer pointer(place);
    ASSERT_TRUE(j.contains(pointer)) << place;
    j[pointer] = wrong;
    const std::string text = refusalOf(j);
    EXPECT_NE(text.find(words), text.npos) << place << ": " << text;
  };
  for (const char* camera :
       {"/camera", "/view/saved/Nische/camera", "/dissection/strokes/0/camera"})
  {
    const std::string of = camera;
    for (const double wrong : {1e308, 180.0, 0.0, -30.0})
      refused(of + "/view_angle_deg", wrong, "view_angle_deg");
    refused(of + "/position_mm/1", 1e308, "position_mm");
    refused(of + "/focal_point_mm/2", -1e308, "focal_point_mm");
    refused(of + "/view_up", {0.0, 0.0, 0.0}, "view_up");
    refused(of + "/view_up/0", 1e200, "view_up");
  }
  for (const double wrong : {1e308, 0.0, -1.0})
    refused("/view/branches/zweiter Zugang ü/parallel_scale_mm", wrong, "parallel_scale_mm");
  for (const double wrong : {1e308, 0.0, -1.0})
    refused("/view/slices/window_width", wrong, "window_width");
  for (const double wrong : {1e308, -1e308})
    refused("/view/slices/window_level", wrong, "window_level");
  refused("/view/slices/crosshair_mm/0", 1e308, "crosshair_mm");
  refused("/view/slices/planes/axial/offset_mm/0", 1e308, "offset_mm");
  refused("/view/slices/planes/axial/zoom", 1e308, "zoom");
  refused("/view/light/falloff_mm", 1e308, "falloff_mm");
  refused("/view/light/wetness", 1e308, "wetness");
  refused("/view/stereo/eye_separation_mm", 1e308, "eyes");
  refused("/view/stereo/convergence_mm", 1e308, "converge");
  refused("/view/clipping/planes/0/point_mm/0", 1e308, "point_mm");
}

// An image without a calibration may have any values of its type, and its window is their range.
TEST(Manifest, KeepsTheWindowOfAnImageOfAnyFloat)
{
  scene::Case value = fullCase();
  const double largest = std::numeric_limits<float>::max();
  for (const auto& [width, level] : {std::pair(3e9, 5e9), std::pair(1e30, -2e30),
                                     std::pair(2.0 * largest, 0.0), std::pair(1e-30, -largest)})
  {
    value.view.slices = scene::ViewState::Slices{{1.0, 2.0, 3.0}, width, level};
    value.view.saved["weit"] = {core::CameraPose{}, value.view.slices, std::nullopt};
    const scene::Case back = scene::fromManifest(scene::toManifest(value), "m.json");
    EXPECT_EQ(back.view.slices->width, width);
    EXPECT_EQ(back.view.slices->level, level);
    EXPECT_EQ(back.view.saved.at("weit").slices->width, width);
  }
}

// Not as what is left of it in the bits of its type.
TEST(Manifest, RefusesAnIntegerThatIsTooLarge)
{
  scene::Case value = fullCase();
  value.view.clipping.crop = core::IndexBox{{0, 1, 2}, {1, 2, 3}};
  value.view.branches["zweiter Zugang ü"] = {core::CameraPose{}, std::nullopt, value.view.clipping};
  value.ct.provenance.interpolatedBeyond = 1;
  const auto good = nlohmann::json::parse(scene::toManifest(value));
  EXPECT_EQ(scene::fromManifest(good.dump(), "m").ct.geometry.dims(),
            fullCase().ct.geometry.dims());
  for (const auto& [place, wrong] :
       {std::pair("/ct/grid/dims/0", "4294967297"), std::pair("/ct/grid/dims/0", "-4294967295"),
        std::pair("/ct/provenance/interpolated_slices_beyond", "4294967297"),
        std::pair("/ct/provenance/interpolated_slices_beyond", "1.9"),
        std::pair("/labels/0/structures/0/index", "65537"),
        std::pair("/labels/0/structures/0/index", "1.5"),
        std::pair("/labels/0/structures/0/voxels", "-1"),
        std::pair("/view/clipping/crop/lower/0", "4294967296"),
        std::pair("/view/clipping/crop/upper/2", "4294967299"),
        std::pair("/view/branches/zweiter Zugang ü/clipping/crop/upper/0", "4294967297"),
        std::pair("/view/clipping/crop/upper/1", "2.5"),
        std::pair("/dissection/strokes/0/bytes", "-1"),
        std::pair("/dissection/strokes/0/bytes", "1.5")})
  {
    auto j = good;
    ASSERT_TRUE(j.contains(nlohmann::json::json_pointer(place))) << place;
    j[nlohmann::json::json_pointer(place)] = nlohmann::json::parse(wrong);
    EXPECT_NE(refusalOf(j).find("out of its range"), std::string::npos) << place << ", " << wrong;
  }
  auto j = good;
  j["petrous_case"] = 4294967297;
  try
  {
    scene::fromManifest(j.dump(), "m.json");
    ADD_FAILURE() << "was read";
  }
  catch (const scene::ManifestError& error)
  {
    EXPECT_EQ(error.reason, scene::ManifestError::Reason::NewerFormat);
    EXPECT_NE(std::string(error.what()).find("4294967297"), std::string::npos) << error.what();
  }
}

// Appearances as in the first manifests: no bone, no transfer functions.
TEST(Manifest, HasSoftTissueOnlyWhereItIsOtherThanAtFirst)
{
  scene::Case value = fullCase();
  const auto before = nlohmann::json::parse(scene::toManifest(value));
  EXPECT_FALSE(before.contains("soft_tissue"));
  value.softTissue.shown = true;
  value.softTissue.opacity = 0.25F;
  value.softTissue.sourceImage = "t2";
  value.softTissue.relative = false;
  value.softTissue.transfer = appearance::softTissueOfMr({100.0, 900.0, false});
  auto j = nlohmann::json::parse(scene::toManifest(value));
  EXPECT_EQ(j.at("petrous_case"), before.at("petrous_case")) << "older programs open it";
  const auto back = scene::fromManifest(j.dump(), "m.json").softTissue;
  EXPECT_TRUE(back == value.softTissue);
  EXPECT_EQ(back.transfer, value.softTissue.transfer);
  j["soft_tissue"]["flags"] = "shown,touchable,drillable"; // by hand
  EXPECT_EQ(appearance::flagsOf(scene::fromManifest(j.dump(), "m.json").softTissue), "shown");
  j.erase("soft_tissue"); // of an older program
  EXPECT_TRUE(scene::fromManifest(j.dump(), "m.json").softTissue == appearance::softTissueLook());
}

TEST(Manifest, OpensOneWithoutTransferFunctionsAsItLookedBefore)
{
  auto j = nlohmann::json::parse(scene::toManifest(fullCase()));
  for (const char* key : {"bone", "dense_bone_hu", "soft_tissue_values"})
    j.erase(key);
  auto& look = j["labels"][0]["structures"][0]["look"];
  look = {{"preset", "nerve"},
          {"color", {0.98, 0.82, 0.16}},
          {"opacity", 1.0},
          {"flags", "shown"},
          {"solid", true}};
  const scene::Case back = scene::fromManifest(j.dump(), "m.json");
  EXPECT_TRUE(back.boneLook.shown);
  EXPECT_EQ(back.boneLook.preset, "bone");
  EXPECT_EQ(back.boneLook.opacity, 1.0F);
  EXPECT_EQ(back.denseBone, 1800.0);
  EXPECT_FALSE(back.softTissueValues);
  const auto& nerve = back.labels[0].structures[0].look;
  EXPECT_FALSE(nerve.transfer.has_value());
  EXPECT_EQ(nerve.shininess, 18.0F);
  EXPECT_EQ(nerve.sourceImage, "");
  EXPECT_LT(nerve.priority, appearance::StructureAppearance{}.priority) << "as its preset";
  EXPECT_EQ(nerve.warning, appearance::StructurePresets::builtIn().preset("nerve").warning);
  EXPECT_GT(nerve.warning, 0.0);
}

TEST(Manifest, RefusesADamagedTransferFunctionByName)
{
  auto j = nlohmann::json::parse(scene::toManifest(fullCase()));
  j["bone"]["transfer"]["points"][0]["opacity"] = 7;
  try
  {
    scene::fromManifest(j.dump(), "m.json");
    FAIL() << "accepted";
  }
  catch (const scene::ManifestError& error)
  {
    EXPECT_EQ(error.reason, scene::ManifestError::Reason::Damaged);
    EXPECT_NE(std::string(error.what()).find("point 1"), std::string::npos) << error.what();
  }
}

TEST(Manifest, KeepsTheTreeOfStrokes)
{
  const scene::Case back = scene::fromManifest(scene::toManifest(fullCase()), "m.json");
  EXPECT_EQ(back.dissection.history().branch().name, "zweiter Zugang ü");
  EXPECT_EQ(back.dissection.history().lineTo(back.dissection.history().branch().tip),
            (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(back.applied(), 2u);
  EXPECT_EQ(back.dissection.history().ahead(), 1u);
  EXPECT_EQ(back.dissection.history().find("main")->tip, 0u);
  EXPECT_TRUE(back.dissection.strokes()[1]->info.recovered);
}

// The history of the first format: a list and a count.
TEST(Manifest, OpensOneWithoutBranches)
{
  auto j = nlohmann::json::parse(scene::toManifest(fullCase()));
  j["petrous_case"] = 1;
  j["dissection"].erase("history");
  j["dissection"]["applied"] = 2;
  const scene::Case back = scene::fromManifest(j.dump(), "m.json");
  EXPECT_EQ(back.dissection.history().branch().name, "main");
  EXPECT_EQ(back.applied(), 2u);
  EXPECT_EQ(back.dissection.history().ahead(), 1u);
  j["dissection"]["applied"] = 4;
  EXPECT_THROW(scene::fromManifest(j.dump(), "m.json"), scene::ManifestError);
}

TEST(Manifest, RefusesABranchThatIsNone)
{
  const auto good = nlohmann::json::parse(scene::toManifest(fullCase()));
  const auto refused = [&good](const char* pointer, const nlohmann::json& bad)
  {
    auto j = good;
    j[nlohmann::json::json_pointer(std::string("/dissection/history") + pointer)] = bad;
    EXPECT_THROW(scene::fromManifest(j.dump(), "m.json"), scene::ManifestError) << pointer << bad;
  };
  refused("/branch", "gone");
  refused("/branches/0/tip", 9);
  refused("/branches/0/tip", -1);
  refused("/branches/0/tip", 1.5);
  refused("/branches/1/name", "main");
  refused("/branches/1/name", "");
  refused("/branches/1/position", 4);
  refused("/parents", {0, 1, 3});
  refused("/parents", {0, 1});
}

TEST(Manifest, RefusesANewerFormatInWords)
{
  std::string text = scene::toManifest(fullCase());
  const auto at = text.find("\"petrous_case\": 3");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 17, "\"petrous_case\": 11");
  try
  {
    scene::fromManifest(text, "m.json");
    FAIL();
  }
  catch (const scene::ManifestError& error)
  {
    EXPECT_EQ(error.reason, scene::ManifestError::Reason::NewerFormat);
    EXPECT_NE(std::string(error.what()).find("format 11"), std::string::npos);
  }
}

TEST(Manifest, RefusesEveryTruncation)
{
  const std::string text = scene::toManifest(fullCase());
  for (std::size_t size = 0; size + 2 < text.size(); size += 37)
    EXPECT_THROW(scene::fromManifest(text.substr(0, size), "m.json"), scene::ManifestError);
}

TEST(Manifest, RefusesWhatContradictsItself)
{
  scene::Case value = fullCase();
  auto j = nlohmann::json::parse(scene::toManifest(value));
  j["dissection"]["strokes"].erase(0);
  EXPECT_THROW(scene::fromManifest(j.dump(), "m.json"), scene::ManifestError);
  value.name = "../escape";
  EXPECT_THROW(scene::fromManifest(scene::toManifest(value), "m.json"), scene::ManifestError);
}

TEST(Manifest, NamesANumberThatIsNotFiniteAndWritesNothing)
{
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(),
                        -std::numeric_limits<double>::infinity()};
  for (const double number : bad)
  {
    const auto refused = [](const scene::Case& value, const std::string& place)
    {
      try
      {
        scene::toManifest(value);
        FAIL() << place;
      }
      catch (const core::InvalidParameter& error)
      {
        EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
      }
    };
    scene::Case value = fullCase();
    value.iso = number;
    refused(value, "iso_hu");
    value = fullCase();
    value.labels[0].structures[0].look.color[1] = static_cast<float>(number);
    refused(value, "labels.0.structures.0.look.color.1");
    value = fullCase();
    value.ct.range.max = number;
    refused(value, "ct.max");
    value = fullCase();
    value.mr[0].registration->error->p95 = number;
    refused(value, "mr.0.registration.error.p95_mm");
    value = fullCase();
    value.mr[0].registration->error->spread->moments(0, 1) = number;
    refused(value, "mr.0.registration.error.spread.moments_mm_rad.1");
  }
}

TEST(Manifest, KeepsTheCodesOfStructures)
{
  scene::Case value = fullCase();
  ASSERT_FALSE(value.labels.empty());
  ASSERT_FALSE(value.labels[0].structures.empty());
  EXPECT_NE(scene::toManifest(value).find("\"petrous_case\": 3"), std::string::npos)
      << "without codes older programs open it";
  volume::SegmentCodes& codes = value.labels[0].structures[0].codes;
  codes.category = {"123037004", "SCT", "Anatomical Structure"};
  codes.type = {"56052001", "SCT", "Facial nerve"};
  codes.typeModifier = {"7771000", "SCT", "Left"};
  codes.region = {"60911003", "SCT", "Temporal bone"};
  codes.regionModifier = {"24028007", "SCT", "Right"};
  codes.algorithm = volume::SegmentCodes::Algorithm::Automatic;
  codes.algorithmName = "a network";
  const std::string text = scene::toManifest(value);
  EXPECT_NE(text.find("\"petrous_case\": 4"), std::string::npos)
      << "older programs would lose the codes, and refuse it";
  const scene::Case again = scene::fromManifest(text, "m");
  EXPECT_EQ(again.labels[0].structures[0].codes, codes);
  EXPECT_EQ(scene::toManifest(again), text);

  std::string wrong = text;
  wrong.replace(wrong.find("\"automatic\""), 11, "\"by magic!\"");
  EXPECT_THROW(scene::fromManifest(wrong, "m"), scene::ManifestError);
  wrong = text;
  wrong.replace(wrong.find("\"56052001\""), 10, "56052001.5");
  EXPECT_THROW(scene::fromManifest(wrong, "m"), scene::ManifestError);
}

TEST(Manifest, KeepsTheNotesOfLabelsAndWhetherAFrameIsSalted)
{
  scene::Case value = fullCase();
  value.labels[0].notes = {"'drum' was left out"};
  value.mr[0].isFrameSalted = true;
  const scene::Case back = scene::fromManifest(scene::toManifest(value), "x");
  EXPECT_EQ(back.labels[0].notes, value.labels[0].notes);
  EXPECT_TRUE(back.mr[0].isFrameSalted);
  EXPECT_EQ(back.mr[0].frameOfReference, value.mr[0].frameOfReference);
  value.mr[0].isFrameSalted = false;
  EXPECT_FALSE(scene::fromManifest(scene::toManifest(value), "x").mr[0].isFrameSalted);
}

namespace
{

scene::Description fullDescription()
{
  scene::Description description;
  description.note = "Erste Zeile: \"hoher Bulbus\" ü\n\n\tdritte \\ Zeile\n";
  description.tags = {"cholesteatoma", "Lehre ü"};
  description.diagnosis = "Cholesteatoma, attic";
  description.procedure = "Canal-wall-up mastoidectomy";
  description.side = scene::Side::Both;
  description.date = "2028-02-29";
  return description;
}

} // namespace

TEST(Manifest, KeepsTheDescription)
{
  scene::Case value = fullCase();
  value.description = fullDescription();
  const std::string text = scene::toManifest(value);
  EXPECT_NE(text.find("\"petrous_case\": 5"), std::string::npos)
      << "older programs would lose the description, and refuse it";
  const scene::Case back = scene::fromManifest(text, "m");
  EXPECT_EQ(back.description, value.description);
  EXPECT_EQ(scene::toManifest(back), text);

  for (const scene::Side side : {scene::Side::Left, scene::Side::Right, scene::Side::Unknown})
  {
    value.description.side = side;
    EXPECT_EQ(scene::fromManifest(scene::toManifest(value), "m").description.side, side);
  }
  value.description.note = std::string(scene::Description::kLongestNote, 'n');
  value.description.tags.clear();
  for (std::size_t n = 0; n < scene::Description::kMaxTags; ++n)
    value.description.tags.push_back("tag " + std::to_string(n));
  value.description.diagnosis = std::string(scene::Description::kLongestLine, 'd');
  EXPECT_EQ(scene::fromManifest(scene::toManifest(value), "m").description, value.description);
}

// What is written without a description is what programs wrote that knew none.
TEST(Manifest, IsWrittenInTheLowestFormatThatHoldsTheCase)
{
  scene::Case value = fullCase();
  const auto formatOf = [](const scene::Case& one)
  { return nlohmann::json::parse(scene::toManifest(one)).at("petrous_case").get<int>(); };
  EXPECT_EQ(formatOf(value), 3);
  EXPECT_FALSE(nlohmann::json::parse(scene::toManifest(value)).contains("description"));
  value.labels[0].structures[0].codes.algorithmName = "a network";
  EXPECT_EQ(formatOf(value), 4);
  EXPECT_FALSE(nlohmann::json::parse(scene::toManifest(value)).contains("description"));
  value.description.tags = {"a"};
  EXPECT_EQ(formatOf(value), 5);
  value.labels[0].structures[0].codes = {};
  EXPECT_EQ(formatOf(value), 5);
  value.description = {};
  EXPECT_EQ(formatOf(value), 3);
}

TEST(Manifest, OpensEachEarlierFormatWithoutADescription)
{
  scene::Case value = fullCase();
  value.dissection =
      dissection::Dissection({value.dissection.strokes()[0]}, dissection::History::line(1, 1));
  const auto written = nlohmann::json::parse(scene::toManifest(value));
  for (int format = 1; format <= 4; ++format)
  {
    auto j = written;
    j["petrous_case"] = format;
    if (format == 1)
    {
      j["dissection"].erase("history");
      j["dissection"]["applied"] = 1;
    }
    if (format < 3)
      j["mr"][0].erase("registration");
    if (format == 4)
      j["labels"][0]["structures"][0]["codes"] = {{"algorithm", "manual"}};
    const scene::Case back = scene::fromManifest(j.dump(), "m.json");
    EXPECT_TRUE(back.description.empty()) << format;
    EXPECT_EQ(back.applied(), 1u) << format;
    // Saved again it is described by nothing, and stays readable for older programs.
    EXPECT_LE(nlohmann::json::parse(scene::toManifest(back)).at("petrous_case").get<int>(), 4);
    scene::Case described = back;
    described.description = fullDescription();
    EXPECT_EQ(scene::fromManifest(scene::toManifest(described), "m").description,
              fullDescription());
  }
}

TEST(Manifest, RefusesAHostileDescription)
{
  scene::Case value = fullCase();
  value.description = fullDescription();
  const auto good = nlohmann::json::parse(scene::toManifest(value));
  const auto refused = [&good](const char* key, const nlohmann::json& bad)
  {
    auto j = good;
    j["description"][key] = bad;
    EXPECT_FALSE(refusalOf(j).empty()) << key << " " << bad.dump().substr(0, 80);
  };
  refused("note", 7);
  refused("note", std::string(scene::Description::kLongestNote + 1, 'n'));
  refused("note", "\x1b[2Jall is well");
  refused("note", std::string("zero\0", 5));
  refused("note", "carriage\rreturn");
  refused("note", "\xc2\x9b"
                  "31m"); // CSI as one character
  refused("diagnosis", "two\nlines");
  refused("diagnosis", std::string(scene::Description::kLongestLine + 1, 'd'));
  refused("procedure", "tab\t");
  refused("procedure", " blank in front");
  refused("procedure", {"a"});
  refused("side", "up");
  refused("side", nullptr);
  refused("side", "Left");
  refused("tags", "one");
  refused("tags", {"a", ""});
  refused("tags", {"Ä", "ä"});
  refused("tags", {"a", 7});
  refused("tags", {std::string(scene::Description::kLongestTag + 1, 't')});
  nlohmann::json many = nlohmann::json::array();
  for (std::size_t n = 0; n <= scene::Description::kMaxTags; ++n)
    many.push_back(std::to_string(n));
  refused("tags", many);
  for (const char* date :
       {"2027-02-29", "2026-13-01", "2026-00-10", "2026-01-32", "2026-1-1", "20260101",
        "2026-01-01T10:00", "1899-12-31", "3000-01-01", "2100-02-29", "+026-01-01", "2026/01/01"})
    refused("planned_on", date);
  for (const nlohmann::json& none : {nlohmann::json(nullptr), nlohmann::json::array(),
                                     nlohmann::json("text"), nlohmann::json(1)})
  {
    auto j = good;
    j["description"] = none;
    EXPECT_FALSE(refusalOf(j).empty()) << none;
  }

  // Nor is it written.
  value.description.diagnosis = "two\nlines";
  EXPECT_THROW(scene::toManifest(value), core::InvalidParameter);
  value.description = fullDescription();
  value.description.note = "\xff";
  EXPECT_THROW(scene::toManifest(value), core::InvalidParameter);
}

// Programs that know nothing of it read the case: the format stays.
TEST(Manifest, KeepsHowTheCaseWasLookedAt)
{
  scene::Case value = fullCase();
  EXPECT_FALSE(nlohmann::json::parse(scene::toManifest(value)).contains("view"));
  value.view.slices = {Vector3d(1.0 / 3.0, -2.5, 1e-7), 4000.0 / 7.0, -0.1};
  core::CameraPose camera;
  camera.position = Vector3d(0.1, 0.2, 0.3);
  value.view.branches["main"].camera = value.view.branches["no branch"].camera = camera;
  const std::string text = scene::toManifest(value);
  EXPECT_NE(text.find("\"petrous_case\": 3"), std::string::npos);
  const scene::Case back = scene::fromManifest(text, "m.json");
  ASSERT_TRUE(back.view.slices);
  EXPECT_EQ(back.view.slices->crosshair, value.view.slices->crosshair);
  EXPECT_EQ(back.view.slices->width, 4000.0 / 7.0);
  EXPECT_EQ(back.view.slices->level, -0.1);
  ASSERT_EQ(back.view.branches.size(), 1U);
  EXPECT_EQ(back.view.branches.at("main").camera->position, Vector3d(0.1, 0.2, 0.3));

  const auto refused = [&text](const char* pointer, const nlohmann::json& bad)
  {
    auto j = nlohmann::json::parse(text);
    j[nlohmann::json::json_pointer(std::string("/view") + pointer)] = bad;
    EXPECT_FALSE(refusalOf(j).empty()) << pointer << bad;
  };
  refused("/slices/window_width", 0.0);
  refused("/slices/window_width", -4.0);
  refused("/slices/window_level", nullptr);
  refused("/slices/crosshair_mm", {1, 2});
  refused("/slices", 7);
  refused("/branches/main", "from above");
  refused("/branches", 7);
  value.view.slices->width = std::numeric_limits<double>::infinity();
  EXPECT_THROW(scene::toManifest(value), core::InvalidParameter);
}

TEST(Manifest, GivesTheDescriptionAlone)
{
  scene::Case value = fullCase();
  EXPECT_TRUE(scene::descriptionFromManifest(scene::toManifest(value), "m").empty());
  value.description = fullDescription();
  const std::string text = scene::toManifest(value);
  EXPECT_EQ(scene::descriptionFromManifest(text, "m"), value.description);
  auto j = nlohmann::json::parse(text);
  j["ct"]["description"] = {{"note", "of the CT"}}; // not the case's
  EXPECT_EQ(scene::descriptionFromManifest(j.dump(), "m"), value.description);
  j["description"]["side"] = "up";
  EXPECT_THROW(scene::descriptionFromManifest(j.dump(), "m"), scene::ManifestError);
  j["petrous_case"] = 11;
  EXPECT_THROW(scene::descriptionFromManifest(j.dump(), "m"), scene::ManifestError);
  EXPECT_THROW(scene::descriptionFromManifest(text.substr(0, text.size() / 2), "m"),
               scene::ManifestError);
}

namespace
{

/// With all of a view, in numbers that only doubles hold.
scene::Case viewedCase()
{
  scene::Case value = fullCase();
  scene::ViewState& view = value.view;
  view.slices = scene::ViewState::Slices{Vector3d(1.0 / 3.0, -2.5, 1e-7), 4000.0 / 7.0, -0.1};
  view.slices->planes.emplace();
  (*view.slices->planes)[2] = {10.0 / 3.0, Vector3d(0.1, 0.2, 0.30000000000000004)};
  view.slices->overlay = scene::ViewState::Slices::Overlay{"T2", "checker", 1.0 / 3.0};
  view.light =
      scene::ViewState::Light{1000.0 / 3.0, 0.1, true, -1.0 / 3.0, true, 2.0 / 3.0, 0.3, true};
  view.stereo = scene::ViewState::Stereo{"interleaved", 22.2, std::nullopt};
  view.clipping.planes = {{Vector3d(0.1, 0.2, 0.3), Vector3d(0.0, 0.6, 0.8)}};
  view.clipping.crop = core::IndexBox{{1, 2, 3}, {4, 5, 6}};
  view.tool = scene::ViewState::Tool{
      {dissection::Burr::Kind::Diamond, 7.0 / 3.0, 54321.1, "coarse"}, 0.7, true};
  view.handpiece = scene::ViewState::Handpiece{-100.0 / 3.0, 200.0 / 9.0, true};
  scene::Attachment film;
  film.kind = scene::Attachment::Kind::Video;
  film.name = "film.mp4";
  film.date = "2026-03-31";
  film.note = "two\nlines";
  film.object = std::string(64, 'a') + ".mp4";
  film.stroke = std::string(64, 'b') + ".stroke";
  film.bytes = 1ULL << 40U;
  scene::Attachment link = film;
  link.name = "far.mp4";
  link.object.clear();
  link.link = "/media/stick/far.mp4";
  link.sha256 = std::string(64, 'c');
  value.attachments = {film, link};
  return value;
}

} // namespace

TEST(Manifest, KeepsAllOfTheViewAndTheAttachmentsToTheBit)
{
  const scene::Case value = viewedCase();
  const std::string text = scene::toManifest(value);
  EXPECT_NE(text.find("\"petrous_case\": 6"), std::string::npos);
  const scene::Case back = scene::fromManifest(text, "m.json");
  EXPECT_EQ(scene::toManifest(back), text);
  EXPECT_TRUE(*back.view.slices == *value.view.slices);
  EXPECT_TRUE(*back.view.light == *value.view.light);
  EXPECT_TRUE(*back.view.stereo == *value.view.stereo);
  EXPECT_TRUE(back.view.clipping == value.view.clipping);
  EXPECT_TRUE(*back.view.tool == *value.view.tool);
  EXPECT_TRUE(back.view.handpiece == value.view.handpiece);
  ASSERT_EQ(back.attachments.size(), 2U);
  EXPECT_EQ(back.attachments[0].bytes, 1ULL << 40U);
  EXPECT_EQ(back.attachments[0].stroke, value.attachments[0].stroke);
  EXPECT_EQ(back.attachments[1].link, "/media/stick/far.mp4");
}

TEST(Manifest, KeepsAHandpieceWithoutATool)
{
  scene::Case value = fullCase();
  value.view.tool.reset();
  value.view.handpiece = scene::ViewState::Handpiece{40.0, 20.0, false};
  const scene::Case back = scene::fromManifest(scene::toManifest(value), "m.json");
  EXPECT_FALSE(back.view.tool);
  EXPECT_TRUE(back.view.handpiece == value.view.handpiece);
}

// Where it was kept at first, in the hand that nothing told.
TEST(Manifest, ReadsTheHandpieceOfATool)
{
  auto json = nlohmann::json::parse(scene::toManifest(viewedCase()));
  json["view"].erase("handpiece");
  json["view"]["tool"]["handpiece"] = {{"turn_deg", 40.0}, {"tilt_deg", 20.0}};
  const scene::Case back = scene::fromManifest(json.dump(), "m.json");
  EXPECT_TRUE(back.view.handpiece == (scene::ViewState::Handpiece{40.0, 20.0, false}));
}

// Written only where they are not the default, so that an older case stays as it was.
TEST(Manifest, ExposureAndToneCurveAreWrittenWhereTheyAreSet)
{
  scene::Case value = viewedCase();
  auto j = nlohmann::json::parse(scene::toManifest(value));
  EXPECT_EQ(j["view"]["light"]["exposure_ev"].get<double>(), -1.0 / 3.0);
  EXPECT_EQ(j["view"]["light"]["tone_curve"], true);
  j["view"]["light"].erase("exposure_ev");
  EXPECT_EQ(j["view"]["light"]["edges"].get<double>(), 2.0 / 3.0);
  j["view"]["light"].erase("tone_curve");
  j["view"]["light"].erase("edges");
  EXPECT_EQ(j["view"]["light"]["grain"].get<double>(), 0.3);
  j["view"]["light"].erase("grain");
  EXPECT_EQ(j["view"]["light"]["exit_surfaces"], true);
  j["view"]["light"].erase("exit_surfaces");
  const scene::Case old = scene::fromManifest(j.dump(), "m.json");
  EXPECT_EQ(old.view.light->exposure, 0.0);
  EXPECT_FALSE(old.view.light->toneCurve);
  EXPECT_EQ(old.view.light->edges, 0.0);
  EXPECT_EQ(old.view.light->grain, 0.0);
  EXPECT_FALSE(old.view.light->exitSurfaces);
  EXPECT_FALSE(*old.view.light == *value.view.light);
  const auto again = nlohmann::json::parse(scene::toManifest(old));
  EXPECT_EQ(again["view"]["light"], j["view"]["light"]);
}

// Programs before format 6 open a case that has nothing of it, and each part alone raises it.
TEST(Manifest, IsOfFormat6OnlyWhereItMustBe)
{
  const scene::Case whole = viewedCase();
  const auto formatOf = [](const scene::Case& value)
  { return nlohmann::json::parse(scene::toManifest(value)).at("petrous_case").get<int>(); };
  scene::Case value = whole;
  value.view = {};
  value.attachments.clear();
  value.view.slices = scene::ViewState::Slices{Vector3d(1, 2, 3), 4.0, 5.0};
  EXPECT_EQ(formatOf(value), formatOf(fullCase()));
  value.description.note = "note";
  EXPECT_EQ(formatOf(value), 5);
  const std::string older = scene::toManifest(value);
  EXPECT_EQ(scene::toManifest(scene::fromManifest(older, "m")), older); // opened and saved
  const auto raised = [&](auto part)
  {
    scene::Case with = value;
    part(with);
    return formatOf(with);
  };
  EXPECT_EQ(raised([&](auto& v) { v.view.slices = whole.view.slices; }), 6);
  EXPECT_EQ(raised([&](auto& v) { v.view.light = whole.view.light; }), 6);
  EXPECT_EQ(raised([&](auto& v) { v.view.stereo = whole.view.stereo; }), 6);
  EXPECT_EQ(raised([&](auto& v) { v.view.clipping.crop = whole.view.clipping.crop; }), 6);
  EXPECT_EQ(raised([&](auto& v) { v.view.clipping.planes = whole.view.clipping.planes; }), 6);
  EXPECT_EQ(raised([&](auto& v) { v.view.tool = whole.view.tool; }), 6);
  EXPECT_EQ(raised([&](auto& v) { v.attachments = whole.attachments; }), 6);
}

TEST(Manifest, KeepsAnInstrumentAndIsOfFormat9OnlyWithOne)
{
  scene::Case value = viewedCase();
  value.view.instrument.emplace();
  auto& instrument = *value.view.instrument;
  instrument.object = std::string(64, 'd') + ".obj";
  instrument.axis = "y-";
  instrument.name = "pick.stl";
  const std::string text = scene::toManifest(value);
  EXPECT_NE(text.find("\"petrous_case\": 9"), std::string::npos);
  const scene::Case back = scene::fromManifest(text, "m.json");
  EXPECT_EQ(scene::toManifest(back), text);
  EXPECT_TRUE(*back.view.instrument == instrument);
  instrument.axis = "y+";
  EXPECT_FALSE(*back.view.instrument == instrument);
  value.view.instrument.reset();
  EXPECT_NE(scene::toManifest(value).find("\"petrous_case\": 6"), std::string::npos);

  for (const auto& [key, wrong] : {std::pair("axis", "w+"), {"axis", "z"}, {"name", "a\nb"}})
  {
    auto j = nlohmann::json::parse(text);
    j["view"]["instrument"][key] = wrong;
    EXPECT_THROW(scene::fromManifest(j.dump(), "m.json"), scene::ManifestError) << wrong;
  }
}

TEST(Manifest, IsOfFormat7OnlyWithSavedViewsTurnedPlanesOrASlab)
{
  const auto formatOf = [](const scene::Case& value)
  { return nlohmann::json::parse(scene::toManifest(value)).at("petrous_case").get<int>(); };
  scene::Case value = viewedCase();
  EXPECT_EQ(formatOf(value), 6);
  const auto raised = [&](auto part)
  {
    scene::Case with = value;
    part(with);
    const std::string text = scene::toManifest(with);
    const scene::Case back = scene::fromManifest(text, "m");
    EXPECT_TRUE(*back.view.slices == *with.view.slices);
    EXPECT_EQ(scene::toManifest(back), text);
    return formatOf(with);
  };
  using Slices = scene::ViewState::Slices;
  EXPECT_EQ(raised([](auto& v) { v.view.slices->slab = Slices::Slab{10.0 / 3.0, "minip"}; }), 7);
  Slices::Turned turned{"free", {}};
  turned.planes[1] = {Vector3d(0.6, 0.8, 0.0), Vector3d(0.0, 0.0, -1.0)};
  EXPECT_EQ(raised([&](auto& v) { v.view.slices->turned = turned; }), 7);
  EXPECT_EQ(raised([](auto& v) { scene::saveView(v, "round window", *v.camera); }), 7);
}

TEST(Manifest, KeepsSavedViewsByNameWithoutTheMrOverTheSlices)
{
  scene::Case value = viewedCase();
  core::CameraPose camera = *value.camera;
  camera.position += Vector3d(1, 2, 3);
  scene::saveView(value, "Facial recess", camera);
  const Vector3d crosshair = value.view.slices->crosshair;
  value.view.slices->crosshair += Vector3d(5, 5, 5);
  const scene::Case back = scene::fromManifest(scene::toManifest(value), "m");
  const auto& saved = back.view.saved.at("Facial recess");
  EXPECT_EQ(saved.camera->position, camera.position);
  EXPECT_EQ(saved.slices->crosshair, crosshair);
  EXPECT_FALSE(saved.slices->overlay);
  scene::Case shown = back;
  scene::showSaved(shown, saved);
  EXPECT_EQ(shown.camera->position, camera.position);
  EXPECT_EQ(shown.view.slices->crosshair, crosshair);
  EXPECT_EQ(shown.view.slices->overlay.has_value(), value.view.slices->overlay.has_value());
  auto without = nlohmann::json::parse(scene::toManifest(value));
  without["view"]["saved"]["Facial recess"].erase("camera");
  EXPECT_NE(refusalOf(without).find("camera"), std::string::npos);
  for (const std::string& bad : {std::string(), std::string(" x"), std::string("a\nb"),
                                 std::string(101, 'a'), std::string("\xff")})
    EXPECT_THROW(scene::saveView(value, bad, camera), core::InvalidParameter);
  EXPECT_EQ(value.view.saved.size(), 1u);
}

TEST(Manifest, KeepsAllOfABranchsViewAndIsOfFormat10OnlyWithMoreThanItsCamera)
{
  const auto formatOf = [](const scene::Case& value)
  { return nlohmann::json::parse(scene::toManifest(value)).at("petrous_case").get<int>(); };
  scene::Case value = viewedCase();
  scene::ViewState::Saved& left = value.view.branches["main"];
  left.camera.emplace();
  left.camera->position = Vector3d(1.0 / 3.0, 0.1, 7.0);
  EXPECT_EQ(formatOf(value), 6);
  value.view.branches["no branch"] = scene::presentView(value);
  EXPECT_EQ(formatOf(value), 6) << "it is not saved";

  left.clipping.emplace();
  EXPECT_EQ(formatOf(value), 10) << "that nothing is cut away is known";
  scene::Case back = scene::fromManifest(scene::toManifest(value), "m");
  ASSERT_TRUE(back.view.branches.at("main").clipping);
  EXPECT_TRUE(back.view.branches.at("main").clipping->empty());
  EXPECT_FALSE(back.view.branches.at("main").slices);

  left.slices = value.view.slices;
  left.slices->overlay.reset();
  left.slices->crosshair = Vector3d(0.1, 0.2, 0.30000000000000004);
  left.clipping->crop = core::IndexBox{{1, 2, 3}, {4, 5, 7}};
  left.clipping->planes = {{Vector3d(0.1, 0.2, 0.3), Vector3d(0.6, 0.0, 0.8)}};
  const std::string text = scene::toManifest(value);
  back = scene::fromManifest(text, "m");
  EXPECT_EQ(scene::toManifest(back), text);
  const scene::ViewState::Saved& read = back.view.branches.at("main");
  EXPECT_EQ(read.camera->position, left.camera->position);
  EXPECT_TRUE(*read.slices == *left.slices);
  EXPECT_TRUE(*read.clipping == *left.clipping);

  const auto refused = [&text](const char* place, const nlohmann::json& bad)
  {
    auto j = nlohmann::json::parse(text);
    const nlohmann::json::json_pointer pointer(std::string("/view/branches/main") + place);
    ASSERT_TRUE(j.contains(pointer)) << place;
    j[pointer] = bad;
    EXPECT_FALSE(refusalOf(j).empty()) << place << " " << bad;
  };
  refused("/camera/view_angle_deg", 180.0);
  refused("/slices/window_width", 0.0);
  refused("/slices/crosshair_mm/0", 1e308);
  refused("/clipping/planes/0/normal", {0, 0, 0});
  refused("/clipping/planes/0/point_mm/0", 1e308);
  refused("/clipping/crop/upper", {1, 1, 1});
  refused("/clipping", 7);
  refused("", nlohmann::json::object());
}

TEST(Manifest, RefusesAHostileViewOrAttachment)
{
  const auto good = nlohmann::json::parse(scene::toManifest(viewedCase()));
  const auto refused = [&good](const char* pointer, const nlohmann::json& bad)
  {
    auto j = good;
    j[nlohmann::json::json_pointer(pointer)] = bad;
    EXPECT_FALSE(refusalOf(j).empty()) << pointer << " " << bad.dump().substr(0, 80);
  };
  refused("/view/slices/planes/axial/zoom", 0.0);
  refused("/view/slices/planes/axial/zoom", 1e300);
  refused("/view/slices/planes", nlohmann::json::object());
  refused("/view/slices/overlay/opacity", -1);
  refused("/view/slices/overlay/mode", "sparkle");
  refused("/view/light/wetness", 2.0);
  refused("/view/light/falloff_mm", -1.0);
  refused("/view/light/shadows", 1);
  refused("/view/light/exposure_ev", 4.5);
  refused("/view/light/exposure_ev", "bright");
  refused("/view/light/tone_curve", 1);
  refused("/view/light/edges", 1.5);
  refused("/view/light/edges", "sharp");
  refused("/view/light/grain", -0.1);
  refused("/view/light/grain", true);
  refused("/view/light/exit_surfaces", 1);
  refused("/view/stereo/mode", "holographic");
  refused("/view/stereo/eye_separation_mm", 1e9);
  refused("/view/clipping/planes/0/normal", {0, 0, 0});
  refused("/view/clipping/crop/lower", {-1, 0, 0});
  refused("/view/clipping/crop/upper", {1, 1, 1});
  refused("/view/tool/burr", "drill");
  refused("/view/tool/diameter_mm", 0.0);
  refused("/view/tool/thrust_n", 1e9);
  refused("/view/handpiece/tilt_deg", 91.0);
  refused("/view/handpiece/turn_deg", "left");
  refused("/view/handpiece/left_hand", 1);
  for (const char* name : {"../film.mp4", "/film.mp4", "a/b", "..", "", "a\n", "far.MP4"})
    refused("/attachments/0/name", name);
  refused("/attachments/0/kind", "virus");
  refused("/attachments/0/bytes", "many");
  refused("/attachments/0/date", "2026-02-30");
  refused("/attachments/0/note", "\x1b[2J");
  refused("/attachments/0/link", "/etc/passwd"); // beside an object
  refused("/attachments/1/link", "relative");
  refused("/attachments/1/link", "/a\n");
  refused("/attachments/1/link", "");
  refused("/attachments/1/sha256", "abc");
  refused("/attachments", nlohmann::json(std::vector<int>(7)));
}

// Terminals obey escape sequences (ECMA-48), and a manifest may be another's.
TEST(Manifest, HoldsNoTextThatATerminalObeys)
{
  const std::string escape = "\x1b]0;owned\x07";
  auto j = nlohmann::json::parse(scene::toManifest(fullCase()));
  j["ct"]["name"] = "ct" + escape;
  j["ct"]["notes"] = {"one" + escape, "two"};
  j["mr"][0]["notes"] = {escape};
  j["labels"][0]["notes"] = {"three\u202e"};
  j["meshes"][0]["notes"] = {"four" + escape};
  j["mr"][0]["registration"]["text"] = "text" + escape;
  j["mr"][0]["registration"]["through"] = escape;
  j["mr"][0]["registration"]["error"] = {{"point_mm", {0, 0, 0}},
                                         {"place", "place" + escape},
                                         {"median_mm", 1},
                                         {"p95_mm", 1},
                                         {"max_mm", 1}};
  j["mr"][0]["registration"]["signed_off"]["who"] = "who" + escape;
  j["mr"][0]["registration"]["signed_off"]["when"] = "when" + escape;
  j["mr"][0]["registration"]["signed_off"]["mr_from_ct"] = j["mr"][0]["mr_from_ct"];
  j["labels"][0]["structures"][0]["codes"] = {
      {"type", {{"value", "1" + escape}, {"scheme", "S" + escape}, {"meaning", "M" + escape}}},
      {"algorithm_name", "A" + escape}};
  j["dissection"]["strokes"][0]["started_at"] = escape;
  j["dissection"]["strokes"][0]["structures"] = {{{"name", "N" + escape}, {"removed_mm3", 1.0}}};
  const scene::Case back = scene::fromManifest(j.dump(), "m.json");
  EXPECT_EQ(back.ct.notes, (std::vector<std::string>{"one]0;owned", "two"}));
  EXPECT_EQ(back.mr[0].registration->text, "text]0;owned");
  EXPECT_EQ(back.mr[0].registration->signOff->who, "who]0;owned");
  const std::string text = scene::toManifest(back);
  EXPECT_EQ(text.find("\\u001b"), std::string::npos) << text;
  EXPECT_EQ(text.find("\\u0007"), std::string::npos);
  EXPECT_EQ(text.find("\xe2\x80\xae"), std::string::npos);
}

namespace
{

std::string textOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

// It is saved as what it is, in whichever format, and nothing of it changes any more.
scene::Case savedAgain(const scene::Case& value)
{
  const std::string text = scene::toManifest(value);
  EXPECT_GE(nlohmann::json::parse(text).at("petrous_case").get<int>(), 3);
  scene::Case back = scene::fromManifest(text, "saved.json");
  EXPECT_EQ(scene::toManifest(back), text);
  return back;
}

} // namespace

// Files as the programs of that time wrote them (Testing/Manifests: of a made-up case, by the
// commits that are named there), with the values that they were given.
TEST(Manifest, OpensStoredFilesOfEarlierPrograms)
{
  for (const int format : {1, 2, 4})
  {
    const std::string file = PETROUS_STORED "format-" + std::to_string(format) + ".json";
    const std::string text = textOf(file);
    ASSERT_EQ(nlohmann::json::parse(text).at("petrous_case").get<int>(), format);
    const scene::Case opened = scene::fromManifest(text, file);
    for (const scene::Case& value : {opened, savedAgain(opened)})
    {
      EXPECT_EQ(value.name, "Ohr links \u00fc");
      EXPECT_EQ(value.revision, 41u);
      EXPECT_EQ(value.iso, 287.123456789012345);
      EXPECT_EQ(value.denseBone, 21034.7);
      EXPECT_FALSE(value.boneLook.shown);
      EXPECT_EQ(value.boneLook.opacity, 0.3F);
      EXPECT_EQ(value.ct.object, "abc.nrrd");
      EXPECT_EQ(value.ct.geometry.dims(), (core::Index3{512, 512, 166}));
      EXPECT_EQ(value.ct.geometry.spacing(), Vector3d(1.0 / 3.0, 0.45, 0.7000000001));
      EXPECT_EQ(value.ct.geometry.origin(), Vector3d(-123.456789, 0.1, 1e-7));
      EXPECT_EQ(value.ct.range.max, 3617);
      EXPECT_EQ(value.ct.notes, std::vector<std::string>{"jitter of 0.02 mm"});
      EXPECT_EQ(value.ct.modality, scene::Modality::Unknown);
      EXPECT_TRUE(value.ct.patient.empty());
      ASSERT_EQ(value.mr.size(), 1u);
      EXPECT_EQ(value.mr[0].name, "t2");
      EXPECT_TRUE(value.mr[0].registered);
      EXPECT_EQ(value.mr[0].mrFromCt.translation(), Vector3d(1, 2, 3));
      EXPECT_EQ(value.mr[0].registration.has_value(), format >= 3);
      ASSERT_EQ(value.labels.size(), 1u);
      ASSERT_EQ(value.labels[0].structures.size(), 1u);
      const scene::StructurePart& nerve = value.labels[0].structures[0];
      EXPECT_EQ(nerve.name, "nerve");
      EXPECT_EQ(nerve.index, 300);
      EXPECT_EQ(nerve.voxels, 123456789012ULL);
      EXPECT_EQ(nerve.look.stiffness, 0.35);
      EXPECT_EQ(nerve.look.sourceImage, "t2");
      EXPECT_FALSE(nerve.look.touchable);
      ASSERT_TRUE(nerve.look.transfer);
      EXPECT_EQ(nerve.codes.type.value, format == 4 ? "56052001" : "");
      EXPECT_EQ(nerve.codes.algorithmName, format == 4 ? "a network" : "");
      ASSERT_EQ(value.meshes.size(), 1u);
      EXPECT_EQ(value.meshes[0].triangles, 12u);
      ASSERT_TRUE(value.camera);
      EXPECT_EQ(value.camera->parallelScale, 33.0);
      EXPECT_TRUE(value.description.empty());
      EXPECT_TRUE(value.attachments.empty());
      // The first format has a list and how many of it are applied, later ones a tree.
      ASSERT_EQ(value.dissection.strokes().size(), format == 1 ? 2u : 3u);
      EXPECT_EQ(value.applied(), format == 1 ? 1u : 2u);
      EXPECT_EQ(value.dissection.history().ahead(), 1u);
      EXPECT_EQ(value.dissection.history().branches().size(), format == 1 ? 1u : 2u);
      const dissection::StrokeInfo& info = value.dissection.strokes()[0]->info;
      EXPECT_EQ(info.removed, 1.0 / 7.0);
      EXPECT_EQ(info.burr.kind, dissection::Burr::Kind::Diamond);
      EXPECT_EQ(info.startedAt, "2026-01-01T00:00:00Z");
      ASSERT_EQ(info.structures.size(), 1u);
      EXPECT_EQ(info.structures[0].volume, 0.25);
    }
  }
}

// Of the phantom patient, as the fuzzers read them.
TEST(Manifest, OpensStoredCasesOfEarlierPrograms)
{
  const auto opened = [](const char* name, int format)
  {
    const std::string text = textOf(std::string(PETROUS_CORPUS) + name);
    EXPECT_EQ(nlohmann::json::parse(text).at("petrous_case").get<int>(), format);
    return scene::fromManifest(text, name);
  };
  const scene::Case third = opened("drilled.json", 3);
  for (const scene::Case& value : {third, savedAgain(third)})
  {
    EXPECT_EQ(value.revision, 7u);
    EXPECT_EQ(value.ct.geometry.dims(), (core::Index3{24, 24, 24}));
    EXPECT_EQ(value.dissection.history().branch().name, "two");
    EXPECT_EQ(value.dissection.history().branches().size(), 2u);
    EXPECT_EQ(value.dissection.strokes().size(), 2u);
    EXPECT_EQ(value.dissection.strokes()[0]->info.removed, 22.359116226434708);
    ASSERT_EQ(value.mr.size(), 1u);
    EXPECT_FALSE(value.mr[0].registered);
    ASSERT_NE(scene::findStructure(value, "sigmoid_sinus"), nullptr);
    EXPECT_EQ(scene::findStructure(value, "sigmoid_sinus")->voxels, 53u);
  }
  const scene::Case fifth = opened("described.json", 5);
  for (const scene::Case& value : {fifth, savedAgain(fifth)})
  {
    EXPECT_EQ(value.description.note, "one line\n\tand \"another\" \u00fc\n");
    EXPECT_EQ(value.description.diagnosis, "cholesteatoma");
    EXPECT_EQ(value.description.side, scene::Side::Left);
    EXPECT_EQ(value.description.date, "2028-02-29");
    EXPECT_EQ(value.description.tags.size(), 2u);
  }
}

TEST(Manifest, KeepsTheSpeedThatAPedalGaveOnlyWhereOneDid)
{
  scene::Case value = fullCase();
  dissection::Stroke byPedal;
  byPedal.info.burr.rpm = 60000.0;
  byPedal.info.speed = dissection::SpindleSpeed{23456.789, 41000.5};
  dissection::Stroke other = byPedal;
  other.info.speed.reset();
  value.dissection = dissection::Dissection({std::make_shared<const dissection::Stroke>(byPedal),
                                             std::make_shared<const dissection::Stroke>(other)},
                                            dissection::History::line(2, 2));
  const std::string text = scene::toManifest(value);
  const auto written = nlohmann::json::parse(text);
  EXPECT_EQ(written["dissection"]["strokes"][0]["rpm"], 60000.0) << "as set";
  EXPECT_FALSE(written["dissection"]["strokes"][1].contains("rpm_mean"));
  const auto back = scene::fromManifest(text, "m.json");
  const auto& speed = back.dissection.strokes()[0]->info.speed;
  ASSERT_TRUE(speed);
  EXPECT_EQ(speed->mean, 23456.789);
  EXPECT_EQ(speed->max, 41000.5);
  EXPECT_FALSE(back.dissection.strokes()[1]->info.speed);
  const dissection::Stroke journalled = scene::strokeFromText(scene::toText(byPedal));
  ASSERT_TRUE(journalled.info.speed);
  EXPECT_EQ(journalled.info.speed->max, 41000.5);
}

TEST(Manifest, NamesABurrOfTheUsersOwnBesideItsKind)
{
  scene::Case value = fullCase();
  dissection::Stroke stroke;
  stroke.info.burr.kind = dissection::Burr::Kind::Diamond;
  stroke.info.burr.name = "coarse-diamond";
  auto usual = stroke;
  usual.info.burr.name.clear();
  value.dissection = dissection::Dissection({std::make_shared<const dissection::Stroke>(stroke),
                                             std::make_shared<const dissection::Stroke>(usual)},
                                            dissection::History::line(2, 2));
  value.view.tool.emplace();
  value.view.tool->burr = stroke.info.burr;
  const std::string text = scene::toManifest(value);
  auto written = nlohmann::json::parse(text);
  auto& first = written["dissection"]["strokes"][0];
  EXPECT_EQ(first["burr"], "diamond") << "what an earlier program reads";
  EXPECT_EQ(first["burr_name"], "coarse-diamond");
  EXPECT_FALSE(written["dissection"]["strokes"][1].contains("burr_name"));
  const auto back = scene::fromManifest(text, "m.json");
  EXPECT_EQ(back.dissection.strokes()[0]->info.burr.name, "coarse-diamond");
  EXPECT_TRUE(back.dissection.strokes()[1]->info.burr.name.empty());
  EXPECT_TRUE(*back.view.tool == *value.view.tool);
  EXPECT_EQ(scene::strokeFromText(scene::toText(stroke)).info.burr.name, "coarse-diamond")
      << "in the journal";

  // As an earlier program saves it.
  first.erase("burr_name");
  written["view"]["tool"].erase("burr_name");
  const auto earlier = scene::fromManifest(written.dump(), "m.json");
  EXPECT_EQ(dissection::nameOf(earlier.dissection.strokes()[0]->info.burr), "diamond");
  EXPECT_EQ(dissection::nameOf(earlier.view.tool->burr), "diamond");
  EXPECT_FALSE(*earlier.view.tool == *value.view.tool);

  for (const char* wrong : {"Doe^John", "two words", "\xE2\x80\xAE"})
  {
    first["burr_name"] = wrong;
    try
    {
      scene::fromManifest(written.dump(), "m.json");
      ADD_FAILURE() << wrong;
    }
    catch (const scene::ManifestError& error)
    {
      EXPECT_EQ(error.reason, scene::ManifestError::Reason::Damaged);
      EXPECT_EQ(std::string(error.what()).find(wrong), std::string::npos) << error.what();
    }
  }
}
