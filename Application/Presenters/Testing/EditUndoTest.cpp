#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <unistd.h>

#include "HeldTool.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Presenters/BoneOpacity.h"
#include "petrous/Presenters/Phrasebook.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Scene/CaseField.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using petrous::presenters::testing::HeldTool;
using petrous::presenters::testing::until;

namespace
{

using Color = std::array<float, 3>;

constexpr int kNerve = 0, kVein = 1;

// Bone where z < 6 mm, with structures s0 (facial_nerve), s1 (sigmoid sinus), s2...
class EditUndoTest : public ::testing::Test
{
protected:
  EditUndoTest()
  {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::temp_directory_path() /
             ("petrous-edits-" + std::to_string(::getpid()) + "-" + test->name());
    std::filesystem::remove_all(folder);
    model = std::make_unique<WorkstationModel>(library::Library(folder));
  }
  ~EditUndoTest() override { std::filesystem::remove_all(folder); }

  void open(int structures = 2)
  {
    scene::Case value;
    value.name = "block";
    value.ct.name = "ct";
    value.ct.geometry = core::GridGeometry({40, 40, 40}, Vector3d::Constant(0.3), Vector3d::Zero());
    auto ct = std::make_shared<volume::Volume<std::int16_t>>(value.ct.geometry);
    auto labels = volume::makeZeroVolume<std::uint16_t>(value.ct.geometry);
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i)
        {
          ct->at(i, j, k) = k < 20 ? std::int16_t{1500} : std::int16_t{-900};
          if (k == 4 && j == 4 && i < structures)
            labels->at(i, j, k) = static_cast<std::uint16_t>(i + 1);
        }
    value.ct.volume = std::make_shared<const volume::IntensityVolume>(
        std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
    volume::LabelMap map;
    map.voxels = labels;
    scene::LabelPart part;
    for (int n = 0; n < structures; ++n)
    {
      scene::StructurePart structure;
      structure.name = name(n);
      structure.index = static_cast<std::uint16_t>(n + 1);
      structure.voxels = 1;
      structure.volume = 0.027;
      part.structures.push_back(structure);
    }
    part.labels = std::make_shared<const volume::LabelMap>(std::move(map));
    value.labels = {part};
    model->adopt(std::move(value));
    model->prepareNow();
  }
  static scene::ViewState::Slices slices()
  {
    scene::ViewState::Slices slices;
    slices.width = 400.0; // HU
    return slices;
  }
  static std::string name(int n)
  {
    return n == kNerve ? "facial_nerve" : n == kVein ? "sigmoid sinus" : "s" + std::to_string(n);
  }
  const appearance::StructureAppearance& look(int n = kNerve) const
  {
    return *model->lookOf(name(n));
  }
  void paint(const Color& color, int n = kNerve)
  {
    auto next = look(n);
    appearance::setColor(next, color);
    model->setLook(name(n), next);
  }
  void stroke()
  {
    HeldTool held({6, 6, 8.5});
    model->startTouch(held.device, held.setup);
    held.drill(true);
    EXPECT_TRUE(until([&] { return !model->advanceTouch().bricks.empty(); }));
    held.drill(false);
    EXPECT_TRUE(until([&] { return model->advanceTouch().strokes.size() == 1; }));
    model->stopTouch();
  }

  std::filesystem::path folder;
  std::unique_ptr<WorkstationModel> model;
};

} // namespace

TEST_F(EditUndoTest, TheSideIsKeptWithTheCaseAndCanBeUndone)
{
  open();
  model->save();
  model->setSide(scene::Side::Left);
  EXPECT_TRUE(model->unsaved());
  EXPECT_EQ(model->undoText(), "side");
  model->save();
  EXPECT_EQ(library::Library(folder).open("block").description.side, scene::Side::Left);
  model->setSide(scene::Side::Left); // nothing to undo
  model->undo();
  EXPECT_EQ(model->value().description.side, scene::Side::Unknown);
  EXPECT_FALSE(model->canUndo());
  model->redo();
  EXPECT_EQ(model->value().description.side, scene::Side::Left);
}

TEST_F(EditUndoTest, EveryStepHasAGermanName)
{
  open();
  int steps = 0;
  const auto expectGerman = [&]
  {
    const std::string english = model->undoText();
    const std::string german = germanPhrases().text(english);
    const std::string kind = english.substr(0, english.find(' '));
    EXPECT_NE(german, english);
    EXPECT_EQ((german + ' ').find(kind + ' '), std::string::npos) << german;
    ++steps;
  };
  using Look = appearance::StructureAppearance;
  const std::function<void(Look&)> changes[] = {
      [](Look& look) { look.shown = !look.shown; },
      [](Look& look) { look.touchable = !look.touchable; },
      [](Look& look) { look.drillable = !look.drillable; },
      [](Look& look) { look.solid = !look.solid; },
      [](Look& look) { look.stiffness += 1.0; },
      [](Look& look) { look.warning += 1.0; },
      [](Look& look) { look.opacity *= 0.5F; },
      [](Look& look) { look.priority += 1; },
      [](Look& look) { look.color[0] = 1.0F - look.color[0]; },
      [](Look& look)
      {
        look.shown = !look.shown;
        look.opacity *= 0.5F;
      }};
  for (const auto& change : changes)
  {
    Look next = look(kVein);
    change(next);
    model->setLook(name(kVein), next);
    expectGerman();
    next = *model->lookOf("ct");
    next.opacity *= 0.5F;
    model->setBoneLook(next);
    expectGerman();
  }
  model->setSide(scene::Side::Left);
  expectGerman();
  model->setIso(512.0);
  expectGerman();
  model->saveView("from behind", {}, slices());
  expectGerman();
  model->removeView("from behind");
  expectGerman();
  model->startBranch("other");
  model->goToBranch("main");
  expectGerman();
  model->goToBranch("other");
  expectGerman();
  EXPECT_EQ(steps, 26);
  for (const auto& property : appearance::kStructureProperties)
    for (const char* of : {" of sigmoid sinus", " of bone", " of 3 parts", " of soft tissue"})
    {
      const std::string german = germanPhrases().text(property.noun + std::string(of));
      EXPECT_EQ(german.find(std::string(property.noun) + " of"), std::string::npos) << german;
      for (const char* word : {"bone", "parts", "soft"})
        EXPECT_EQ(german.find(word), std::string::npos) << german;
    }
}

TEST_F(EditUndoTest, WhatWasAddedIsTakenBackAsOneStepAndComesAgain)
{
  open();
  model->setSide(scene::Side::Left);
  const scene::Case before = model->value();
  scene::Case with = before;
  scene::ImagePart mr = with.ct;
  mr.name = "T2";
  with.mr.push_back(mr);
  scene::LabelPart part = with.labels.front();
  auto map = *part.labels.get();
  part.labels = std::make_shared<const volume::LabelMap>(std::move(map));
  part.drawnOn = "T2";
  part.structures.resize(2);
  part.structures[0].name = "cochlea";
  part.structures[1].name = "vestibule";
  with.labels.push_back(part);
  model->takeParts(before, std::move(with));
  EXPECT_EQ(model->undoText(), "addition of 3 parts");
  for (int n = 0; n < 2; ++n)
  {
    model->undo();
    EXPECT_FALSE(scene::findMr(model->value(), "T2"));
    EXPECT_FALSE(scene::findStructure(model->value(), "cochlea"));
    EXPECT_EQ(model->value().labels.size(), before.labels.size());
    EXPECT_EQ(model->value().description.side, scene::Side::Left) << "an older change";
    model->redo();
    ASSERT_TRUE(scene::findMr(model->value(), "T2"));
    ASSERT_TRUE(scene::findStructure(model->value(), "vestibule"));
    EXPECT_EQ(model->value().labels.size(), before.labels.size() + 1);
    EXPECT_EQ(model->value().labels.back().structures.front().name, "cochlea");
    EXPECT_EQ(model->value().labels.back().drawnOn, "T2");
  }
  model->undo();
  EXPECT_EQ(model->undoText(), "side");
}

TEST_F(EditUndoTest, TakesEachChangeBackInTheOrderInWhichItWasMade)
{
  open();
  const Color before = look().color;
  const double iso = model->value().iso;
  model->setIso(500.0);
  paint({1.0F, 0.0F, 0.0F});
  stroke();
  model->renamePart("sigmoid sinus", "sinus");
  auto hidden = look();
  hidden.shown = false;
  model->setLook("facial_nerve", hidden);
  model->removePart("sinus");
  auto bone = model->value().boneLook;
  bone.shown = false;
  model->setBoneLook(bone);

  std::vector<std::string> texts;
  while (model->canUndo())
  {
    texts.push_back(model->undoText());
    model->undo();
  }
  EXPECT_EQ(texts, (std::vector<std::string>{"hide bone", "removal of sinus", "hide facial nerve",
                                             "name of sinus", "stroke 1", "colour of facial nerve",
                                             "bone threshold"}));
  EXPECT_EQ(look().color, before);
  EXPECT_TRUE(look().shown);
  EXPECT_EQ(model->value().iso, iso);
  EXPECT_EQ(model->value().applied(), 0u);
  EXPECT_TRUE(model->value().boneLook.shown);
  EXPECT_TRUE(scene::findStructure(model->value(), "sigmoid sinus"));

  std::vector<std::string> again;
  while (model->canRedo())
  {
    again.insert(again.begin(), model->redoText());
    model->redo();
  }
  EXPECT_EQ(again, texts);
  EXPECT_EQ(look().color, (Color{1.0F, 0.0F, 0.0F}));
  EXPECT_FALSE(look().shown);
  EXPECT_EQ(model->value().iso, 500.0);
  EXPECT_EQ(model->value().applied(), 1u);
  EXPECT_FALSE(model->value().boneLook.shown);
  EXPECT_FALSE(scene::findStructure(model->value(), "sinus"));
}

TEST_F(EditUndoTest, AColourThatIsDraggedIsOneStep)
{
  open();
  const auto before = look();
  for (int n = 1; n <= 40; ++n)
    paint({0.0F, static_cast<float>(n) / 40.0F, 1.0F});
  model->undo();
  EXPECT_TRUE(look() == before);
  EXPECT_FALSE(model->canUndo());
  model->redo();
  EXPECT_EQ(look().color, (Color{0.0F, 1.0F, 1.0F}));
}

TEST_F(EditUndoTest, BonesOpacityIsOneStepAlsoThroughItsOtherPreset)
{
  open();
  const auto before = model->value().boneLook;
  for (int n = 9; n >= 1; --n)
    model->setBoneLook(withOpacity(model->value().boneLook, 0.1 * n));
  EXPECT_EQ(model->undoText(), "opacity of bone");
  model->undo();
  EXPECT_TRUE(model->value().boneLook == before);
  EXPECT_FALSE(model->canUndo());
}

TEST_F(EditUndoTest, SoftTissueIsAPartOfItsOwn)
{
  open();
  const auto before = model->value().softTissue;
  auto next = before;
  next.shown = true;
  model->setLook(scene::kSoftTissue, next);
  EXPECT_TRUE(model->value().softTissue.shown);
  EXPECT_TRUE(model->drawable()) << "nothing has to be prepared";
  EXPECT_EQ(model->undoText(), "show soft tissue");
  next.opacity = 0.5F;
  model->setLook(scene::kSoftTissue, next);
  EXPECT_EQ(model->undoText(), "opacity of soft tissue");
  model->undo();
  model->undo();
  EXPECT_TRUE(model->value().softTissue == before);
  EXPECT_FALSE(model->canUndo());
}

TEST_F(EditUndoTest, AMarkThatIsSetTwiceIsTwoSteps)
{
  open();
  for (const bool shown : {false, true})
  {
    auto next = look();
    next.shown = shown;
    model->setLook("facial_nerve", next);
  }
  EXPECT_EQ(model->undoText(), "show facial nerve");
  model->undo();
  EXPECT_FALSE(look().shown);
  model->undo();
  EXPECT_TRUE(look().shown);
}

TEST_F(EditUndoTest, ManyStructuresAreOneStepAndOneNotification)
{
  constexpr int kMany = 255;
  open(kMany);
  int notified = 0;
  model->events.appearanceChanged = [&notified] { ++notified; };
  std::vector<PartLook> looks;
  for (int n = 0; n < kMany; ++n)
  {
    looks.push_back({name(n), look(n)});
    looks.back().look.opacity = 0.5F;
  }
  looks.push_back({"nobody", {}});
  model->setLooks(looks);
  EXPECT_EQ(notified, 1);
  EXPECT_EQ(model->undoText(), "opacity of 255 parts");
  model->undo();
  EXPECT_EQ(notified, 2);
  for (int n = 0; n < kMany; ++n)
    EXPECT_EQ(look(n).opacity, 1.0F);
}

TEST_F(EditUndoTest, WhatIsAsItWasIsNoStep)
{
  open();
  int notified = 0;
  model->events.appearanceChanged = [&notified] { ++notified; };
  model->setLook("facial_nerve", look());
  model->setIso(model->value().iso);
  model->setLook("nobody", {});
  EXPECT_EQ(notified, 0);
  EXPECT_FALSE(model->canUndo());
}

TEST_F(EditUndoTest, AppearanceGoesBackWithTheToolInTheHandAndTissuePutsItAway)
{
  open();
  auto next = look();
  next.drillable = false;
  model->setLook("facial_nerve", next);
  paint({1.0F, 0.0F, 0.0F});
  model->prepareNow();
  HeldTool held({6, 6, 8.5});
  model->startTouch(held.device, held.setup);
  model->undo(); // the colour
  EXPECT_TRUE(model->touching());
  EXPECT_TRUE(model->ready());
  model->undo(); // what the drill takes
  EXPECT_FALSE(model->touching());
  EXPECT_FALSE(model->ready());
  EXPECT_TRUE(look().drillable);
}

TEST_F(EditUndoTest, AnOpenStrokeComesFirstAndWhatWasBeforeItNext)
{
  open();
  paint({1.0F, 0.0F, 0.0F});
  HeldTool held({6, 6, 8.5});
  model->startTouch(held.device, held.setup);
  held.drill(true);
  ASSERT_TRUE(until([&] { return !model->advanceTouch().bricks.empty(); }));
  EXPECT_EQ(model->undoText(), "stroke 1");
  held.drill(false);
  bool back = false;
  model->events.stepped = [&back](bool undone) { back = undone; };
  model->undo();
  EXPECT_TRUE(until(
      [&]
      {
        model->advanceTouch();
        return back;
      }));
  EXPECT_EQ(model->undoText(), "colour of facial nerve");
  EXPECT_EQ(model->redoText(), "stroke 1");
  model->undo();
  EXPECT_TRUE(model->touching());
  EXPECT_FALSE(model->canUndo());
  model->stopTouch(); // before its device goes
}

TEST_F(EditUndoTest, StrokesOfAnotherBranchDoNotBarTheWay)
{
  open();
  const Color before = look().color;
  paint({1.0F, 0.0F, 0.0F});
  stroke();
  model->startBranch("other");
  model->goToState("other", dissection::History::kStart);
  EXPECT_EQ(model->undoText(), "change to approach other") << "there is no stroke here";
  model->undo();
  EXPECT_EQ(model->undoText(), "colour of facial nerve");
  model->undo();
  EXPECT_EQ(look().color, before);
  EXPECT_EQ(model->undoText(), "stroke 1") << "of the branch";
  model->redo();
  EXPECT_EQ(look().color, (Color{1.0F, 0.0F, 0.0F}));
}

TEST_F(EditUndoTest, WhatWasCutAwayOnOneApproachIsNotUndoneOnOneThatBeginsThere)
{
  open();
  stroke();
  const auto branch = [this] { return model->value().dissection.history().branch().name; };
  const auto cropped = [](int width)
  {
    scene::ViewState::Clipping clipping;
    clipping.crop = core::IndexBox{{0, 0, 0}, {width, 40, 40}};
    return clipping;
  };
  // As the window does.
  const auto crop = [this](const scene::ViewState::Clipping& to)
  {
    const scene::ViewState::Clipping from = model->value().view.clipping;
    const auto set = [this](const scene::ViewState::Clipping& clipping)
    { model->setClipping(clipping); };
    set(to);
    model->edits().did({"crop box", {}, [set, from] { set(from); }, [set, to] { set(to); }});
  };
  crop(cropped(20));
  model->startBranch("other");
  EXPECT_TRUE(model->value().view.clipping == cropped(20)) << "it goes on from what is seen";
  crop(cropped(10));
  model->undo();
  EXPECT_TRUE(model->value().view.clipping == cropped(20));
  EXPECT_EQ(model->undoText(), "change to approach other");
  model->undo();
  EXPECT_EQ(branch(), "main");
  ASSERT_TRUE(model->value().dissection.history().find("other")) << "no deletion";
  EXPECT_TRUE(model->value().view.clipping == cropped(20));
  model->undo();
  EXPECT_TRUE(model->value().view.clipping.empty());
  EXPECT_EQ(model->undoText(), "stroke 1");
  EXPECT_TRUE(model->value().view.branches.at("other").clipping == cropped(20));

  model->redo();
  model->redo();
  EXPECT_EQ(branch(), "other");
  EXPECT_TRUE(model->value().view.clipping == cropped(20));
  model->redo();
  EXPECT_TRUE(model->value().view.clipping == cropped(10));
}

TEST_F(EditUndoTest, AnApproachThatWasGoneToAtAnotherStateIsInItsOwnAfterUndo)
{
  open();
  stroke();
  model->startBranch("other");
  stroke();
  model->goToBranch("main");
  const auto there = [this]
  {
    const dissection::History::Branch* other = model->value().dissection.history().find("other");
    return other ? other->position : dissection::History::kStart;
  };
  ASSERT_EQ(there(), 1u);
  model->goToState("other", dissection::History::kStart);
  EXPECT_TRUE(model->value().dissection.mask().untouched());
  model->undo();
  EXPECT_EQ(model->value().dissection.history().branch().name, "main");
  EXPECT_EQ(model->value().applied(), 1u);
  EXPECT_EQ(there(), 1u);
  model->redo();
  EXPECT_EQ(model->value().dissection.history().branch().name, "other");
  EXPECT_TRUE(model->value().dissection.mask().untouched());
  // Another way from there: the one before is a branch of its own, and still whole.
  stroke();
  model->undo();
  model->undo();
  EXPECT_EQ(model->value().dissection.history().branch().name, "main");
  EXPECT_EQ(there(), dissection::History::kStart) << "its own state is not on it any more";
  ASSERT_TRUE(model->value().dissection.history().find("other~1"));
  EXPECT_EQ(model->value().dissection.history().find("other~1")->position, 1u);
}

TEST_F(EditUndoTest, StrokesAreNumberedOverAllBranchesAsTheReportNumbersThem)
{
  open();
  stroke();
  stroke();
  model->undo();
  model->startBranch("other"); // after the first
  stroke();
  EXPECT_EQ(model->value().applied(), 2u);
  EXPECT_EQ(model->undoText(), "stroke 3");
  model->undo();
  EXPECT_EQ(model->redoText(), "stroke 3");
  EXPECT_EQ(model->undoText(), "change to approach other");
  model->undo();
  EXPECT_EQ(model->undoText(), "stroke 1");
}

// As its name is shown: it is no name that a user gave, and is translated.
TEST_F(EditUndoTest, TheDeletionOfTheMainApproachHasAPhraseOfItsOwn)
{
  open();
  stroke();
  model->startBranch("other");
  model->removeBranch("main");
  EXPECT_EQ(model->undoText(), "deletion of the main approach");
  EXPECT_EQ(germanPhrases().find(model->undoText()), "Löschen des Hauptzugangs");
}

TEST_F(EditUndoTest, AnApproachThatWasDeletedComesBackWithItsStrokes)
{
  open();
  stroke();
  model->startBranch("other");
  stroke();
  model->goToBranch("main");
  const double removed = model->value().removedVolume();
  model->renameBranch("other", "deep");
  EXPECT_EQ(model->undoText(), "name of approach deep");
  EXPECT_THROW(model->renameBranch("deep", "main"), core::InvalidParameter);
  EXPECT_THROW(model->removeBranch("main"), core::InvalidParameter) << "the present one";
  model->removeBranch("deep");
  EXPECT_EQ(model->undoText(), "deletion of approach deep");
  EXPECT_TRUE(model->undoChangesParts());
  EXPECT_EQ(model->value().dissection.history().branches().size(), 1u);
  model->save();
  stroke();
  model->undo();
  EXPECT_EQ(model->value().removedVolume(), removed);
  model->undo();
  ASSERT_TRUE(model->value().dissection.history().find("deep"));
  model->undo();
  ASSERT_TRUE(model->value().dissection.history().find("other"));
  model->redo();
  model->redo();
  EXPECT_EQ(model->value().dissection.history().branches().size(), 1u);
  model->undo();
  model->goToState("deep", 1);
  EXPECT_GT(model->value().removedVolume(), removed);
  model->save();
  WorkstationModel again{library::Library(folder)};
  again.open("block");
  EXPECT_EQ(again.value().dissection.history().branch().name, "deep");
  EXPECT_EQ(again.value().removedVolume(), model->value().removedVolume());
}

TEST_F(EditUndoTest, GoingToAnotherApproachIsTakenBackWithWhatWasSeenThere)
{
  open();
  stroke();
  model->startBranch("other");
  stroke();
  scene::ViewState::Clipping cropped;
  cropped.crop = core::IndexBox{{0, 0, 0}, {20, 40, 40}};
  model->setClipping(cropped);
  core::CameraPose seen; // by the window
  seen.viewAngle = 11.0;
  int shown = 0;
  model->events.viewWanted = [&] { model->setCamera(seen); };
  model->events.viewChanged = [&]
  {
    seen = model->value().camera.value();
    ++shown;
  };
  const auto branch = [this] { return model->value().dissection.history().branch().name; };
  const auto clipping = [this]() -> const scene::ViewState::Clipping&
  { return model->value().view.clipping; };

  model->goToBranch("main");
  EXPECT_EQ(shown, 1);
  EXPECT_TRUE(clipping().empty());
  EXPECT_EQ(model->undoText(), "change to the main approach");
  EXPECT_TRUE(model->undoChangesParts()) << "the tool is put away";
  seen.viewAngle = 22.0;
  stroke();
  EXPECT_EQ(model->undoText(), "stroke 3");
  model->undo();
  model->undo();
  EXPECT_EQ(branch(), "other");
  EXPECT_EQ(model->value().applied(), 2u);
  EXPECT_TRUE(clipping() == cropped);
  EXPECT_EQ(seen.viewAngle, 11.0);
  EXPECT_EQ(model->undoText(), "stroke 2") << "in its order again";

  model->redo();
  EXPECT_EQ(branch(), "main");
  EXPECT_TRUE(clipping().empty());
  EXPECT_EQ(seen.viewAngle, 22.0);
  EXPECT_EQ(model->redoText(), "stroke 3");
  model->redo();
  EXPECT_EQ(model->value().applied(), 2u);

  // To a state of another one, too; and what is saved is what was left.
  model->goToState("other", 0);
  EXPECT_EQ(model->undoText(), "change to approach other");
  EXPECT_EQ(shown, 4);
  model->undo();
  EXPECT_EQ(branch(), "main");
  EXPECT_EQ(seen.viewAngle, 22.0);
  model->save();
  const scene::Case saved = library::Library(folder).open("block");
  EXPECT_TRUE(saved.view.branches.at("other").clipping == cropped);
  EXPECT_EQ(saved.view.branches.at("other").camera->viewAngle, 11.0);
}

TEST_F(EditUndoTest, GoingToAStateIsAsUndoingOrRedoingItsStrokes)
{
  open();
  stroke();
  stroke();
  paint({1.0F, 0.0F, 0.0F});
  model->goToState("main", dissection::History::kStart);
  EXPECT_TRUE(model->value().dissection.mask().untouched());
  EXPECT_EQ(model->redoText(), "stroke 1");
  model->redo();
  EXPECT_EQ(model->value().applied(), 1u);
  model->goToState("main", 1);
  EXPECT_EQ(model->value().applied(), 2u);
  EXPECT_EQ(model->undoText(), "stroke 2");
  EXPECT_THROW(model->goToState("main", 7), core::InvalidParameter);
  EXPECT_EQ(model->value().applied(), 2u);
}

TEST_F(EditUndoTest, ARemovalIsUndoneWhereverItIsAmongOthersThatWerePutBack)
{
  open(4);
  model->removePart("s2");
  model->removePart("s3");
  model->restorePart();
  EXPECT_EQ(model->undoText(), "return of s3");
  model->undo();
  EXPECT_FALSE(scene::findStructure(model->value(), "s3"));
  EXPECT_EQ(model->removedPart(), "s3");
  model->undo();
  model->undo();
  EXPECT_TRUE(scene::findStructure(model->value(), "s3"));
  EXPECT_TRUE(scene::findStructure(model->value(), "s2"));
  EXPECT_FALSE(model->canUndo());
  EXPECT_EQ(model->value().labels.front().structures[2].name, "s2") << "at its place";
}

TEST_F(EditUndoTest, AViewThatIsReplacedOrRemovedComesBack)
{
  open();
  const auto positionOf = [this](const char* view)
  { return model->value().view.saved.at(view).camera->position; };
  core::CameraPose camera;
  camera.position = {1, 0, 0};
  model->saveView("recess", camera, slices());
  camera.position = {2, 0, 0};
  model->saveView("recess", camera, slices());
  EXPECT_EQ(model->undoText(), "view 'recess'");
  model->undo();
  EXPECT_EQ(positionOf("recess"), Vector3d(1, 0, 0));
  model->redo();
  EXPECT_EQ(positionOf("recess"), Vector3d(2, 0, 0));
  int told = 0;
  model->events.savedViewsChanged = [&told] { ++told; };
  model->removeView("recess");
  EXPECT_TRUE(model->value().view.saved.empty());
  EXPECT_EQ(model->undoText(), "removal of view 'recess'");
  model->undo();
  EXPECT_EQ(positionOf("recess"), Vector3d(2, 0, 0));
  EXPECT_EQ(told, 2);
  model->removeView("nothing");
  EXPECT_EQ(told, 2);
  model->undo();
  model->undo();
  EXPECT_TRUE(model->value().view.saved.empty());
}

TEST_F(EditUndoTest, OneViewMoreThanThereMayBeIsRefusedInWordsWithoutEffect)
{
  open();
  for (std::size_t n = 0; n < scene::ViewState::kMaxSaved; ++n)
    model->saveView("view " + std::to_string(n), {}, slices());
  const std::string before = model->undoText();
  EXPECT_THROW(model->saveView("one more", {}, slices()), core::InvalidParameter);
  EXPECT_EQ(model->value().view.saved.size(), scene::ViewState::kMaxSaved);
  EXPECT_EQ(model->undoText(), before);
  EXPECT_NO_THROW(model->saveView("view 7", {}, slices())) << "it is there already";
}

TEST_F(EditUndoTest, AnotherCaseHasNoStepsYet)
{
  open();
  paint({1.0F, 0.0F, 0.0F});
  open();
  EXPECT_FALSE(model->canUndo());
  paint({1.0F, 0.0F, 0.0F});
  model->close();
  EXPECT_FALSE(model->canUndo());
  EXPECT_FALSE(model->canRedo());
  EXPECT_EQ(model->undoText(), "");
}

TEST_F(EditUndoTest, PriorityAndLumenChangeWhatIsTissue)
{
  open();
  auto next = look();
  next.priority = 5;
  model->setLook("facial_nerve", next);
  EXPECT_FALSE(model->ready());
  EXPECT_FALSE(model->drawable());
  model->prepareNow();
  next.solid = false;
  model->setLook("facial_nerve", next);
  EXPECT_FALSE(model->ready());
  EXPECT_FALSE(model->drawable());
}
