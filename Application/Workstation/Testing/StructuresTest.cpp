#include <algorithm>
#include <array>
#include <set>
#include <string>

#include <QAbstractItemModelTester>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QSlider>
#include <QSpinBox>
#include <QTimer>
#include <QToolButton>
#include <QTranslator>
#include <QTreeView>

#include "ColorChooser.h"
#include "GuiTest.h"
#include "Language.h"
#include "StructuresModel.h"
#include "StructuresPanel.h"
#include "petrous/Appearance/SoftTissues.h"
#include "petrous/Appearance/StructureProperties.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

// The list of structures, driven as a user drives it: each click and key is counted.
class Structures : public GuiTest
{
protected:
  // The ball's structure, and others without voxels.
  void openWith(const std::vector<std::pair<std::string, std::string>>& others)
  {
    scene::Case value = ballCase("ball");
    const auto presets = appearance::StructurePresets::builtIn();
    std::uint16_t index = 1;
    value.labels[0].structures[0].look = presets.preset("nerve");
    for (const auto& [name, preset] : others)
    {
      scene::StructurePart structure = value.labels[0].structures[0];
      structure.name = name;
      structure.index = ++index;
      structure.look = presets.preset(preset);
      value.labels[0].structures.push_back(structure);
    }
    library().save(value);
    openWindow();
    window().resize(1280, 900);
    QTest::qWait(50);
  }
  void openMany(int count)
  {
    std::vector<std::pair<std::string, std::string>> others;
    for (int n = 1; n < count; ++n)
      others.emplace_back("s" + std::to_string(n), n % 2 == 0 ? "vein" : "other");
    openWith(others);
  }
  presenters::WorkstationModel& model()
  {
    return const_cast<presenters::WorkstationModel&>(window().model());
  }
  const appearance::StructureAppearance& look(const std::string& part)
  {
    return *model().lookOf(part);
  }
  std::vector<std::string> shown()
  {
    std::vector<std::string> names;
    for (const auto& structure : model().value().labels[0].structures)
      if (structure.look.shown)
        names.push_back(structure.name);
    return names;
  }
  void click(QWidget* widget, const QPoint& at, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    ++events;
    QTest::mouseClick(widget, Qt::LeftButton, modifiers, at);
  }
  void clickCell(const std::string& part, int column = 0, int fromLeft = -1,
                 Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    const QModelIndex cell = structureCell(part, column);
    structureList().scrollTo(cell);
    const QRect rect = structureList().visualRect(cell);
    click(structureList().viewport(),
          fromLeft < 0 ? rect.center() : QPoint(rect.left() + fromLeft, rect.center().y()),
          modifiers);
  }
  void key(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    ++events;
    QApplication::setActiveWindow(&window());
    QTest::keyClick(QApplication::focusWidget(), static_cast<Qt::Key>(key), modifiers);
  }
  template <class T>
  T* find(const char* name)
  {
    return window().findChild<T*>(name);
  }
  QToolButton* colorCell(const QColor& color)
  {
    auto* chooser = find<ColorChooser>("colorChooser");
    if (chooser)
      for (auto* cell : chooser->findChildren<QToolButton*>())
        if (cell->property("color").value<QColor>() == color)
          return cell;
    return nullptr;
  }

  int events = 0;
};

constexpr int kSwatch = 7; // px from the left of a name

} // namespace

TEST_F(Structures, AStructureIsRecolouredWithTwoClicks)
{
  openWith({});
  const QColor wanted = QColor::fromHsv(180, 200, 240);
  const auto before = look("nerve");
  clickCell("nerve", 0, kSwatch);
  QToolButton* cell = colorCell(wanted);
  ASSERT_TRUE(cell);
  click(cell, cell->rect().center());
  EXPECT_EQ(events, 2);
  const auto color = look("nerve").color;
  EXPECT_NEAR(color[0], wanted.redF(), 0.002);
  EXPECT_NEAR(color[1], wanted.greenF(), 0.002);
  EXPECT_NEAR(color[2], wanted.blueF(), 0.002);
  EXPECT_EQ(action("Undo")->text(), "&Undo colour of nerve");
  action("Undo")->trigger();
  EXPECT_TRUE(look("nerve") == before);
  EXPECT_FALSE(action("Undo")->isEnabled());
  EXPECT_EQ(action("Redo")->text(), "&Redo colour of nerve");
}

// The selection, blue, does not tint what tells structures apart.
TEST_F(Structures, AColourIsDrawnAsItIsInASelectedRow)
{
  openWith({});
  appearance::StructureAppearance yellow = look("nerve");
  yellow.color = {247.0F / 255.0F, 222.0F / 255.0F, 115.0F / 255.0F};
  model().setLooks({{"nerve", yellow}}, {});
  const auto swatch = [this]
  {
    const QRect rect = structureList().visualRect(structureCell("nerve"));
    const QImage drawn = structureList().viewport()->grab(rect).toImage();
    return drawn.pixelColor(drawn.width() * kSwatch / rect.width(), drawn.height() / 2);
  };
  EXPECT_EQ(swatch().name(), "#f7de73");
  structureList().setCurrentIndex(structureCell("nerve"));
  ASSERT_TRUE(structureList().selectionModel()->isSelected(structureCell("nerve")));
  EXPECT_EQ(swatch().name(), "#f7de73");
}

// Of a part with a transfer function, which is tinted too; the pointer rests on others first.
TEST_F(Structures, AColourOfATransferFunctionIsOneStepHoweverManyAreTried)
{
  openWith({});
  using appearance::ControlPoint;
  const auto pointAt = [](double value, float red, float green, float blue)
  {
    ControlPoint point;
    point.value = value;
    point.color = {red, green, blue};
    point.opacity = 0.3F;
    return point;
  };
  appearance::StructureAppearance tinted = look("nerve");
  tinted.color = {0.97F, 0.87F, 0.45F};
  tinted.transfer = appearance::TransferFunction(
      {pointAt(100.0, 0.31F, 0.29F, 0.17F), pointAt(900.0, 0.7F, 0.63F, 0.33F)});
  model().setLooks({{"nerve", tinted}}, "preparation");
  const QColor wanted = QColor::fromHsv(90, 110, 255);
  clickCell("nerve", 0, kSwatch);
  auto* chooser = find<ColorChooser>("colorChooser");
  ASSERT_TRUE(chooser);
  emit chooser->previewed(Qt::black);
  emit chooser->previewed(wanted);
  QToolButton* cell = colorCell(wanted);
  ASSERT_TRUE(cell);
  click(cell, cell->rect().center());
  appearance::StructureAppearance expected = tinted;
  appearance::setColor(expected,
                       {static_cast<float>(wanted.redF()), static_cast<float>(wanted.greenF()),
                        static_cast<float>(wanted.blueF())});
  EXPECT_TRUE(look("nerve") == expected) << "the black in between is not seen";
  EXPECT_EQ(action("Undo")->text(), "&Undo colour of nerve");
  action("Undo")->trigger();
  EXPECT_TRUE(look("nerve") == tinted);
  EXPECT_EQ(action("Undo")->text(), "&Undo preparation");
}

TEST_F(Structures, AColourThatIsTriedIsTakenBackExactlyWhenPointerOrFocusLeaveIt)
{
  openWith({});
  const auto before = look("nerve");
  const QColor one = QColor::fromHsv(180, 200, 240);
  const auto red = [&] { return look("nerve").color[0]; };
  clickCell("nerve", 0, kSwatch);
  auto* chooser = find<ColorChooser>("colorChooser");
  ASSERT_TRUE(chooser);
  QToolButton* cell = colorCell(one);
  ASSERT_TRUE(cell);
  const QPointF middle = cell->rect().center();
  QEvent leave(QEvent::Leave);

  QEnterEvent enter(middle, middle, middle);
  QApplication::sendEvent(cell, &enter);
  const auto* rest = chooser->findChild<QTimer*>();
  ASSERT_TRUE(rest);
  EXPECT_FALSE(rest->isActive()) << "the pop-up opened beneath the pointer";

  QMouseEvent move(QEvent::MouseMove, middle, Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(cell, &move);
  ASSERT_TRUE(waitFor([&] { return std::abs(red() - one.redF()) < 0.002; }));
  QApplication::sendEvent(cell, &leave);
  EXPECT_TRUE(waitFor([&] { return look("nerve") == before; }));
  EXPECT_FALSE(action("Undo")->isEnabled()) << "no step of undo";

  QTest::keyClick(chooser->focusWidget(), Qt::Key_Right);
  EXPECT_FALSE(look("nerve") == before);
  const auto byKey = look("nerve");
  QApplication::sendEvent(cell, &move);
  ASSERT_TRUE(waitFor([&] { return std::abs(red() - one.redF()) < 0.002; }));
  QApplication::sendEvent(cell, &leave);
  EXPECT_TRUE(waitFor([&] { return look("nerve") == byKey; })) << "which Return would choose";
  chooser->findChild<QPushButton*>("moreColors")->setFocus(Qt::TabFocusReason);
  EXPECT_TRUE(look("nerve") == before);
  EXPECT_FALSE(action("Undo")->isEnabled());
  QTest::keyClick(chooser, Qt::Key_Escape);
  EXPECT_TRUE(look("nerve") == before);
}

TEST_F(Structures, OneOfSixtyIsShownAloneWithTwoClicksAndAllAgainWithOne)
{
  openMany(60);
  auto* only = find<QToolButton>("onlyThese");
  clickCell("s33");
  click(only, only->rect().center());
  EXPECT_EQ(events, 2);
  EXPECT_EQ(shown(), std::vector<std::string>{"s33"});
  EXPECT_TRUE(look("ct").shown);
  EXPECT_TRUE(only->isChecked());
  EXPECT_EQ(action("Undo")->text(), "&Undo only s33");
  click(only, only->rect().center());
  EXPECT_EQ(shown().size(), 60u);
  EXPECT_FALSE(only->isChecked());
  events = 0;
  clickCell("s20", StructuresModel::columnOf("shown"), -1, Qt::AltModifier);
  EXPECT_EQ(events, 1);
  EXPECT_EQ(shown(), std::vector<std::string>{"s20"});
  action("Undo")->trigger();
  EXPECT_EQ(shown().size(), 60u);
}

TEST_F(Structures, BoneIsARowThatIsHiddenAndRecolouredLikeOthers)
{
  openWith({});
  const QModelIndex bone = structureCell("ct");
  EXPECT_EQ(bone.data().toString(), "Bone");
  EXPECT_EQ(bone.row(), 0);
  const QImage with = picture();
  EXPECT_TRUE(structureList().model()->setData(
      structureCell("ct", StructuresModel::columnOf("shown")), Qt::Unchecked, Qt::CheckStateRole));
  EXPECT_FALSE(look("ct").shown);
  EXPECT_GT(differentPixels(with, picture(), 20), 3000);
  for (const char* key : {"touchable", "drillable", "warn_mm"})
  {
    const QModelIndex cell = structureCell("ct", StructuresModel::columnOf(key));
    EXPECT_FALSE(cell.data(Qt::CheckStateRole).isValid()) << key;
    EXPECT_FALSE(structureList().model()->setData(cell, 1.0, Qt::EditRole)) << key;
    EXPECT_FALSE(structureList().model()->setData(cell, Qt::Unchecked, Qt::CheckStateRole)) << key;
  }
  action("Undo")->trigger();
  EXPECT_TRUE(look("ct").shown);
  clickCell("ct", 0, kSwatch);
  QToolButton* cell = colorCell(QColor::fromHsv(0, 110, 255));
  ASSERT_TRUE(cell);
  click(cell, cell->rect().center());
  EXPECT_EQ(action("Undo")->text(), "&Undo colour of bone");
}

TEST_F(Structures, BoneIsNotOfferedThePresetsOfLumens)
{
  openWith({});
  const auto* presets = find<QComboBox>("structurePreset");
  const auto isOffered = [presets](const QString& preset)
  {
    const int row = presets->findData(preset);
    return row >= 0 && (presets->model()->index(row, 0).flags() & Qt::ItemIsEnabled);
  };
  structureList().setCurrentIndex(structureCell("ct"));
  EXPECT_TRUE(isOffered("bone-translucent"));
  EXPECT_FALSE(isOffered("ear-canal") || isOffered("air-cells"));
  structureList().selectionModel()->select(structureCell("nerve"),
                                           QItemSelectionModel::Select | QItemSelectionModel::Rows);
  EXPECT_TRUE(isOffered("ear-canal")) << "the nerve can have it";
  structureList().setCurrentIndex(structureCell(scene::kSoftTissue));
  EXPECT_FALSE(isOffered("ear-canal"));
}

TEST_F(Structures, SoftTissueIsARowBelowBoneThatIsDrawnOnly)
{
  openWith({});
  const QModelIndex row = structureCell(scene::kSoftTissue);
  EXPECT_EQ(row.data().toString(), "Soft tissue");
  EXPECT_EQ(row.row(), 1);
  EXPECT_FALSE(row.parent().isValid());
  EXPECT_FALSE(look(scene::kSoftTissue).shown);
  auto& list = structureList();
  for (const char* key : {"touchable", "drillable", "warn_mm"})
  {
    const QModelIndex cell = structureCell(scene::kSoftTissue, StructuresModel::columnOf(key));
    EXPECT_FALSE(cell.data(Qt::CheckStateRole).isValid()) << key;
    EXPECT_FALSE(list.model()->setData(cell, 1.0, Qt::EditRole)) << key;
    EXPECT_FALSE(list.model()->setData(cell, Qt::Checked, Qt::CheckStateRole)) << key;
  }
  list.setCurrentIndex(row);
  EXPECT_FALSE(find<QWidget>("structureMaterial")->isEnabled());
  EXPECT_FALSE(find<QWidget>("structure_stiffness_n_per_mm")->isEnabled());
  list.setFocus();
  key(Qt::Key_Space);
  EXPECT_TRUE(look(scene::kSoftTissue).shown);
  EXPECT_EQ(action("Undo")->text(), "&Undo show soft tissue");
  key(Qt::Key_F2); // neither renamed
  key(Qt::Key_Delete);
  EXPECT_TRUE(structureCell(scene::kSoftTissue).isValid());
  EXPECT_EQ(model().value().labels[0].structures.size(), 1u);
  find<QSpinBox>("structureOpacityBox")->setValue(40);
  EXPECT_FLOAT_EQ(look(scene::kSoftTissue).opacity, 0.4F);
  EXPECT_EQ(look("ct").opacity, 1.0F);

  // Several: it is hidden along, and not shown along.
  list.selectAll();
  find<QToolButton>("hideThese")->click();
  EXPECT_FALSE(look(scene::kSoftTissue).shown);
  EXPECT_FALSE(look("ct").shown);
  find<QToolButton>("showThese")->click();
  EXPECT_TRUE(look("ct").shown);
  EXPECT_FALSE(look(scene::kSoftTissue).shown) << "it would veil the others";
}

// Its mark of drilling keeps the drill off its wall, and so has an effect.
TEST_F(Structures, ALumenHasNoMarkOfTouchAndSaysWhy)
{
  openWith({{"canal", "ear-canal"}, {"antrum", "air-cells"}, {"carotid", "artery"}});
  auto& list = structureList();
  const int touch = StructuresModel::columnOf("touchable");
  const int drill = StructuresModel::columnOf("drillable");
  const auto tip = [](const QModelIndex& cell) { return cell.data(Qt::ToolTipRole).toString(); };
  const QModelIndex kind = structureCell("canal").parent();
  for (const QModelIndex& row : {structureCell("canal"), kind})
  {
    const QModelIndex cell = row.siblingAtColumn(touch);
    EXPECT_FALSE(cell.data(Qt::CheckStateRole).isValid());
    EXPECT_FALSE(cell.flags() & Qt::ItemIsUserCheckable);
    EXPECT_TRUE(tip(cell).contains("a space without tissue")) << tip(cell).toStdString();
    EXPECT_FALSE(list.model()->setData(cell, Qt::Unchecked, Qt::CheckStateRole));
    EXPECT_TRUE(row.siblingAtColumn(drill).flags() & Qt::ItemIsUserCheckable);
  }
  EXPECT_TRUE(look("canal").touchable) << "the mark stays, for a preset of tissue";
  EXPECT_TRUE(structureCell("carotid", touch).data(Qt::CheckStateRole).isValid());

  auto* mark = find<QCheckBox>("structure_touchable");
  auto* stiffness = find<QDoubleSpinBox>("structure_stiffness_n_per_mm");
  list.setCurrentIndex(structureCell("carotid"));
  EXPECT_TRUE(mark->isEnabled() && stiffness->isEnabled());
  EXPECT_FALSE(mark->toolTip().contains("a space without tissue"));
  auto* softTissue = find<QPushButton>("structureSoftTissue");
  ASSERT_TRUE(softTissue->isEnabled());
  for (QAction* one : softTissue->menu()->actions())
  {
    EXPECT_FALSE(one->toolTip().isEmpty()) << "its source";
    if (one->data() == "artery")
      one->trigger();
  }
  const appearance::SoftTissue& artery = *appearance::findSoftTissue("artery");
  EXPECT_EQ(look("carotid").stiffness, artery.stiffness);
  EXPECT_EQ(stiffness->value(), artery.stiffness);
  list.setCurrentIndex(structureCell("canal"));
  EXPECT_FALSE(softTissue->isEnabled());
  EXPECT_FALSE(mark->isEnabled() || stiffness->isEnabled());
  EXPECT_EQ(mark->checkState(), Qt::Unchecked);
  for (const QWidget* widget : {static_cast<QWidget*>(mark), static_cast<QWidget*>(stiffness)})
    EXPECT_TRUE(widget->toolTip().contains("a space without tissue"))
        << widget->toolTip().toStdString();
  EXPECT_TRUE(find<QCheckBox>("structure_drillable")->isEnabled());

  // Of several, those that can be felt are changed.
  list.selectionModel()->select(structureCell("carotid"),
                                QItemSelectionModel::Select | QItemSelectionModel::Rows);
  ASSERT_TRUE(mark->isEnabled());
  mark->click();
  EXPECT_FALSE(look("carotid").touchable);
  EXPECT_TRUE(look("canal").touchable);

  list.setCurrentIndex(structureCell("canal"));
  auto* preset = find<QComboBox>("structurePreset");
  emit preset->activated(preset->findData("nerve"));
  EXPECT_TRUE(mark->isEnabled());
  EXPECT_EQ(structureCell("canal", touch).data(Qt::CheckStateRole).toInt(), Qt::Checked);
}

// At the width that the panel has at first: names are elided before a check box scrolls away.
TEST_F(Structures, WhatIsSetStaysInSightWithAToolInTheHand)
{
  scene::Case value = ballCase("ball");
  auto& nerve = value.labels[0].structures[0];
  nerve.name = "superior semicircular canal of the left ear and its ampulla";
  nerve.volume = 2664.8;
  nerve.look.warning = 12.5;
  library().save(value);
  for (const char* language : {"en", "long", "de"})
  {
    SCOPED_TRACE(language);
    LongTexts longer; // each is removed when it goes
    QTranslator german;
    const bool isGerman = std::string(language) == "de";
    if (isGerman && !hasLanguage("de"))
      continue;
    ASSERT_TRUE(!isGerman || german.load(":/translations/petrous_de.qm"));
    if (std::string(language) != "en")
      QApplication::installTranslator(isGerman ? &german : &longer);
    openWindow("ball");
    auto& list = structureList();
    const QHeaderView& header = *list.header();
    QTest::keyClick(&view(), Qt::Key_D);
    ASSERT_TRUE(waitFor(
        [&]
        {
          QTest::mouseMove(&view(), view().rect().center() + QPoint(3, 0));
          QTest::mouseMove(&view(), view().rect().center());
          return !list.isColumnHidden(StructuresModel::Burr);
        }));
    for (const int column :
         {static_cast<int>(StructuresModel::Name), static_cast<int>(StructuresModel::Burr),
          StructuresModel::columnOf("shown"), StructuresModel::columnOf("touchable"),
          StructuresModel::columnOf("drillable"), StructuresModel::columnOf("warn_mm")})
    {
      const auto data = [&](int role)
      { return list.model()->headerData(column, Qt::Horizontal, role); };
      const QString name = data(Qt::AccessibleTextRole).toString();
      EXPECT_FALSE(name.isEmpty()) << column;
      EXPECT_FALSE(data(Qt::ToolTipRole).toString().isEmpty()) << name.toStdString();
      const QString title = data(Qt::DisplayRole).toString();
      EXPECT_NE(title.isEmpty(), data(Qt::DecorationRole).isNull()) << name.toStdString();
      EXPECT_GT(header.sectionSize(column), header.fontMetrics().horizontalAdvance(title))
          << name.toStdString();
      const int left = header.sectionViewportPosition(column);
      EXPECT_GE(left, 0) << name.toStdString();
      EXPECT_LE(left + header.sectionSize(column), list.viewport()->width()) << name.toStdString();
    }
    closeWindow();
  }
}

TEST_F(Structures, SoftTissueThatCannotBeDrawnSaysSo)
{
  openWith({});
  auto soft = look(scene::kSoftTissue);
  soft.shown = true;
  soft.transfer.reset();
  model().setLook(scene::kSoftTissue, soft);
  const QModelIndex row = structureCell(scene::kSoftTissue);
  EXPECT_TRUE(waitFor([&] { return row.data().toString() == "Soft tissue (not drawn)"; }));
  EXPECT_TRUE(row.data(Qt::ToolTipRole).toString().contains("fill air"));
  auto* box = find<QCheckBox>("softTissue"); // of the Picture panel
  EXPECT_TRUE(box->isChecked());
  EXPECT_TRUE(box->toolTip().contains("fill air"));
  auto* over = view().findChild<QLabel*>("guessed"); // the notes over the picture
  EXPECT_TRUE(waitFor(
      [&]
      { return !over->isHidden() && over->text().contains("Soft tissue is not drawn: it has "); }))
      << over->text().toStdString();
  box->click();
  EXPECT_FALSE(look(scene::kSoftTissue).shown);
  EXPECT_FALSE(over->text().contains("not drawn"));
  EXPECT_EQ(structureCell(scene::kSoftTissue).data().toString(), "Soft tissue");
  action("Undo")->trigger();
  EXPECT_TRUE(box->isChecked());
}

TEST_F(Structures, TheCaseMenuRenamesAndRemovesWhatIsSelected)
{
  openWith({{"two", "other"}});
  QMenu* menu = nullptr;
  for (QAction* top : window().menuBar()->actions())
    if (top->text() == "&Case")
      menu = top->menu();
  ASSERT_TRUE(menu);
  const auto entries = [menu]
  {
    emit menu->aboutToShow();
    QStringList texts;
    for (const QAction* one : menu->actions())
      texts += one->text();
    return texts.filter(QRegularExpression("^(Rename|Remove) "));
  };
  auto& list = structureList();
  list.selectionModel()->clear();
  EXPECT_TRUE(entries().isEmpty());
  list.setCurrentIndex(structureCell("ct"));
  EXPECT_TRUE(entries().isEmpty()) << "it is the case's image";
  list.setCurrentIndex(structureCell("nerve"));
  EXPECT_EQ(entries(), QStringList({QString::fromUtf8("Rename “nerve”…"),
                                    QString::fromUtf8("Remove “nerve”")}));
  for (QAction* one : menu->actions())
    if (one->text().startsWith("Remove "))
    {
      one->trigger();
      break;
    }
  EXPECT_TRUE(waitFor([this] { return !model().lookOf("nerve"); }));
  EXPECT_TRUE(model().lookOf("two"));
  action("Undo")->trigger();
  EXPECT_TRUE(waitFor([this] { return model().lookOf("nerve") != nullptr; }));
}

TEST_F(Structures, AColourIsPreviewedAndLeavesNoTraceIfItIsNotTaken)
{
  openWith({});
  const auto before = look("nerve");
  clickCell("nerve", 0, kSwatch);
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Right);
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Down);
  EXPECT_NE(look("nerve").color, before.color) << "while it is being chosen";
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
  EXPECT_TRUE(look("nerve") == before);
  EXPECT_FALSE(action("Undo")->isEnabled());
  EXPECT_FALSE(action("Redo")->isEnabled());
}

TEST_F(Structures, ASearchIgnoresMarksAndCaseAndKnowsPresetsAndKinds)
{
  openWith({{"Fl\xC3\xA4"
             "che",
             "other"},
            {"sigmoid sinus", "vein"},
            {"carotid", "artery"}});
  auto* search = find<QLineEdit>("structuresSearch");
  const auto found = [&]
  {
    std::vector<std::string> names;
    for (const char* name : {"ct", "nerve",
                             "Fl\xC3\xA4"
                             "che",
                             "sigmoid sinus", "carotid"})
    {
      const QModelIndex row = structureCell(name);
      if (!structureList().isRowHidden(row.row(), row.parent()) &&
          !(row.parent().isValid() && structureList().isRowHidden(row.parent().row(), {})))
        names.push_back(name);
    }
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(found().size(), 5u);
  search->setText("FLAC");
  EXPECT_EQ(found(), Names{"Fl\xC3\xA4"
                           "che"});
  search->setText("vessels");
  EXPECT_EQ(found(), (Names{"sigmoid sinus", "carotid"}));
  search->setText("artery");
  EXPECT_EQ(found(), Names{"carotid"});
  EXPECT_EQ(structureCell("carotid").parent().data().toString(), "Vessels (1 of 2)");
  search->setText("sinus sig");
  EXPECT_EQ(found(), Names{"sigmoid sinus"});
  // What is not seen is not changed.
  structureList().selectAll();
  find<QToolButton>("hideThese")->click();
  EXPECT_EQ(shown(), (Names{"nerve",
                            "Fl\xC3\xA4"
                            "che",
                            "carotid"}));
  search->setFocus();
  QApplication::setActiveWindow(&window());
  QTest::keyClick(search, Qt::Key_Escape);
  EXPECT_EQ(found().size(), 5u);
  EXPECT_EQ(structureCell("carotid").parent().data().toString(), "Vessels (2)");
}

TEST_F(Structures, SeveralAreEditedAtOnceInOneStep)
{
  openMany(6);
  structureList().setCurrentIndex(structureCell("s1"));
  for (const char* name : {"s2", "s3"})
    structureList().selectionModel()->select(structureCell(name), QItemSelectionModel::Select |
                                                                      QItemSelectionModel::Rows);
  const auto& panel = *window().findChild<StructuresPanel*>();
  EXPECT_EQ(panel.selectedParts(), (std::vector<std::string>{"s1", "s2", "s3"}));
  auto* warning = find<QDoubleSpinBox>("structure_warn_mm");
  EXPECT_EQ(warning->prefix(), "differ: ") << "a vein is warned of, others are not";
  warning->setValue(3.5);
  EXPECT_EQ(warning->prefix(), "");
  for (const char* name : {"s1", "s2", "s3"})
    EXPECT_EQ(look(name).warning, 3.5) << name;
  EXPECT_EQ(look("s4").warning, 2.0);
  EXPECT_EQ(action("Undo")->text(), "&Undo warning distance of 3 parts");
  find<QSpinBox>("structureOpacityBox")->setValue(40);
  find<QDoubleSpinBox>("structure_stiffness_n_per_mm")->setValue(2.0);
  find<QDoubleSpinBox>("structure_priority")->setValue(7.0);
  auto* material = find<QComboBox>("structureMaterial");
  material->setCurrentIndex(material->findData("nerve"));
  emit material->activated(material->currentIndex());
  find<QCheckBox>("structure_drillable")->click();
  EXPECT_NEAR(look("s2").opacity, 0.4F, 1e-6);
  EXPECT_EQ(look("s2").stiffness, 2.0);
  EXPECT_EQ(look("s2").priority, 7);
  EXPECT_EQ(look("s2").tissue, "nerve");
  EXPECT_FALSE(look("s2").drillable);
  auto* preset = find<QComboBox>("structurePreset");
  emit preset->activated(preset->findData("nerve"));
  EXPECT_EQ(look("s3").preset, "nerve");
  EXPECT_EQ(structureCell("s3").parent(), structureCell("nerve").parent()) << "among the nerves";
  EXPECT_EQ(panel.selectedParts().size(), 3u) << "still selected";
  for (int n = 0; n < 7; ++n)
    action("Undo")->trigger();
  EXPECT_FALSE(action("Undo")->isEnabled());
  EXPECT_EQ(look("s2").opacity, 1.0F);
  EXPECT_EQ(look("s2").warning, 2.0);
}

TEST_F(Structures, ASliderThatIsHiddenWhileItIsDraggedIsLetGo)
{
  openWith({});
  structureList().setCurrentIndex(structureCell("nerve"));
  auto* slider = window().findChild<QSlider*>("structureOpacity");
  ASSERT_TRUE(slider && slider->isEnabled());
  slider->setSliderDown(true);
  window().findChild<QDockWidget*>("structuresDock")->hide();
  EXPECT_FALSE(slider->isSliderDown());
}

// Return would create the structure that is being segmented, say.
TEST_F(Structures, ReturnInACellIsNoShortcut)
{
  openWith({});
  const QModelIndex cell = structureCell("nerve", StructuresModel::columnOf("warn_mm"));
  structureList().setColumnHidden(cell.column(), false);
  structureList().edit(cell);
  auto* box = structureList().viewport()->findChild<QAbstractSpinBox*>();
  ASSERT_TRUE(box);
  box->setFocus();
  QKeyEvent shortcut(QEvent::ShortcutOverride, Qt::Key_Return, Qt::NoModifier);
  shortcut.ignore();
  QApplication::sendEvent(box, &shortcut);
  EXPECT_TRUE(shortcut.isAccepted());
}

TEST_F(Structures, AllOfItIsReachedByKeys)
{
  openWith({{"sigmoid sinus", "vein"}, {"carotid", "artery"}});
  QApplication::setActiveWindow(&window());
  structureList().setFocus();
  structureList().setCurrentIndex(structureCell("nerve"));
  key(Qt::Key_Space);
  EXPECT_FALSE(look("nerve").shown);
  key(Qt::Key_Space);
  EXPECT_TRUE(look("nerve").shown);
  key(Qt::Key_Down); // the kind of vessels
  key(Qt::Key_Space);
  EXPECT_EQ(shown(), std::vector<std::string>{"nerve"});
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(shown().size(), 3u);
  key(Qt::Key_Left); // folded
  EXPECT_FALSE(structureList().isExpanded(structureCell("carotid").parent()));
  key(Qt::Key_Right);
  key(Qt::Key_Down);
  key(Qt::Key_Space, Qt::ShiftModifier);
  EXPECT_EQ(shown(), std::vector<std::string>{"sigmoid sinus"});
  key(Qt::Key_Space, Qt::ShiftModifier);
  EXPECT_EQ(shown().size(), 3u);
  key(Qt::Key_Return);
  ASSERT_TRUE(QApplication::focusWidget());
  EXPECT_EQ(QApplication::focusWidget()->objectName(), "structureColor");
  key(Qt::Key_Escape);
  EXPECT_TRUE(structureList().hasFocus());
  key(Qt::Key_Slash);
  EXPECT_EQ(QApplication::focusWidget()->objectName(), "structuresSearch");
  key(Qt::Key_Escape);
  structureList().setCurrentIndex(structureCell("carotid"));
  key(Qt::Key_Delete);
  EXPECT_FALSE(structureCell("carotid").isValid());
  EXPECT_TRUE(settled());
  EXPECT_EQ(action("Undo")->text(), "&Undo removal of carotid");
  action("Undo")->trigger();
  EXPECT_TRUE(structureCell("carotid").isValid());
}

// Strokes, appearances and threshold go back one by one, as they were made.
TEST_F(Structures, UndoGoesBackThroughStrokesAndAppearances)
{
  saveBall("ball");
  openWindow();
  const auto& value = window().model().value();
  drill(300);
  ASSERT_EQ(value.applied(), 1u);
  auto hidden = look("nerve");
  hidden.shown = false;
  model().setLook("nerve", hidden);
  EXPECT_EQ(action("Undo")->text(), "&Undo hide nerve");
  EXPECT_TRUE(action("Drill")->isChecked());
  action("Undo")->trigger();
  EXPECT_TRUE(look("nerve").shown);
  EXPECT_EQ(value.applied(), 1u);
  EXPECT_TRUE(action("Drill")->isChecked()) << "the tool stays in the hand";
  EXPECT_EQ(action("Undo")->text(), "&Undo stroke 1");
  action("Undo")->trigger();
  EXPECT_TRUE(waitFor([&] { return value.applied() == 0; }));
  EXPECT_EQ(action("Redo")->text(), "&Redo stroke 1");
  action("Redo")->trigger();
  EXPECT_TRUE(waitFor([&] { return value.applied() == 1; }));
  action("Redo")->trigger();
  EXPECT_FALSE(look("nerve").shown);
}

TEST_F(Structures, TheTreeOfRowsIsSound)
{
  openMany(12);
  QAbstractItemModelTester tester(structureList().model(),
                                  QAbstractItemModelTester::FailureReportingMode::Fatal);
  const QModelIndex kind = structureCell("s2").parent();
  EXPECT_EQ(kind.data().toString(), "Vessels (5)");
  const int column = StructuresModel::columnOf("shown");
  EXPECT_EQ(kind.siblingAtColumn(column).data(Qt::CheckStateRole).toInt(), Qt::Checked);
  structureList().model()->setData(structureCell("s4", column), Qt::Unchecked, Qt::CheckStateRole);
  EXPECT_EQ(kind.siblingAtColumn(column).data(Qt::CheckStateRole).toInt(), Qt::PartiallyChecked);
  structureList().model()->setData(kind.siblingAtColumn(column), Qt::Checked, Qt::CheckStateRole);
  EXPECT_TRUE(look("s4").shown);
  model().renamePart("s4", "jugular bulb");
  model().removePart("s6");
  EXPECT_TRUE(structureCell("jugular bulb").isValid());
  EXPECT_EQ(structureCell("s2").parent().data().toString(), "Vessels (4)");
}

TEST_F(Structures, WhatIsSelectedStaysSoUnderAnotherName)
{
  openMany(12);
  auto* panel = window().findChild<StructuresPanel*>();
  clickCell("s4");
  clickCell("s6", 0, -1, Qt::ControlModifier);
  const auto selected = [panel]
  {
    const auto parts = panel->selectedParts();
    return std::set<std::string>(parts.begin(), parts.end());
  };
  ASSERT_EQ(selected(), (std::set<std::string>{"s4", "s6"}));
  model().renamePart("s4", "jugular bulb");
  EXPECT_EQ(selected(), (std::set<std::string>{"jugular bulb", "s6"}));
  // Another one gets the name that was selected.
  model().renamePart("s2", "s4");
  EXPECT_EQ(selected(), (std::set<std::string>{"jugular bulb", "s6"}));
  action("Undo")->trigger();
  action("Undo")->trigger();
  EXPECT_EQ(selected(), (std::set<std::string>{"s4", "s6"}));
  action("Redo")->trigger();
  EXPECT_EQ(selected(), (std::set<std::string>{"jugular bulb", "s6"}));
  // Of another kind, it stands elsewhere in the list.
  auto nerve = look("jugular bulb");
  nerve.preset = "nerve";
  model().setLook("jugular bulb", nerve);
  EXPECT_EQ(selected(), (std::set<std::string>{"jugular bulb", "s6"}));
}

TEST_F(Structures, NoDistanceOfAnotherPlaceStaysWhereNoneIsKnown)
{
  openWith({});
  StructuresPanel panel(model());
  panel.caseChanged();
  panel.show();
  const auto* rows =
      static_cast<StructuresModel*>(panel.findChild<QTreeView*>("structures")->model());
  const auto distance = [rows]
  { return rows->rowOf("nerve").siblingAtColumn(StructuresModel::Burr).data().toString(); };
  const auto ask = [this, &panel](double away)
  {
    panel.toolMeasured(model().surroundings(
        presenters::MeasuredTool(1.0),
        {kBallCenter + Eigen::Vector3d(0.0, 0.0, away), Eigen::Quaterniond::Identity()},
        panel.showsNear()));
  };
  ASSERT_TRUE(waitFor(
      [&]
      {
        ask(9.0);
        return !distance().isEmpty();
      }));
  EXPECT_TRUE(distance().contains(QString::fromUtf8(" mm ± "))) << distance().toStdString();
  model().forgetNearby();
  ask(100.0); // measured anew
  EXPECT_EQ(distance().toStdString(), "");
}
