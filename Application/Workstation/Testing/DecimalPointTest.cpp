#include <clocale>

#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QStatusBar>
#include <QTest>

#include "GuiTest.h"

using namespace petrous;
using namespace petrous::workstation;

class DecimalPointTest : public GuiTest
{
};

TEST_F(DecimalPointTest, WhatAFieldCannotTakeLeavesItsNumber)
{
  openWindow();
  QDoubleSpinBox box;
  box.setDecimals(0);
  box.setRange(-1000.0, 3000.0);
  box.setValue(300.0);
  for (const char* typed : {"1,200", "1.200,5", "99999"})
  {
    enterNumber(box, typed);
    EXPECT_EQ(box.value(), 300.0) << typed;
    EXPECT_TRUE(box.property("refused").toBool()) << typed;
  }
  enterNumber(box, "1200");
  EXPECT_EQ(box.value(), 1200.0);
  EXPECT_FALSE(box.property("refused").toBool());
}

TEST_F(DecimalPointTest, SaysWhyInTheStatusBarAndTheMarkGoes)
{
  openWindow();
  auto* exposure = window().findChild<QDoubleSpinBox*>("exposure");
  ASSERT_TRUE(exposure);
  const auto type = [exposure](const char* text) { enterNumber(*exposure, text); };
  type("9");
  EXPECT_EQ(exposure->value(), 0.0);
  EXPECT_EQ(window().statusBar()->currentMessage(), "9 is above the most, 4 EV");
  EXPECT_TRUE(exposure->property("refused").toBool());
  type("-77");
  EXPECT_EQ(window().statusBar()->currentMessage(), "-7 is below the least, -4 EV");
  type("1,2,3");
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("is not possible here"))
      << window().statusBar()->currentMessage().toStdString();
  EXPECT_TRUE(exposure->property("refused").toBool());
  EXPECT_TRUE(waitFor([exposure] { return !exposure->property("refused").toBool(); }));
}

// The next keys would act on the view: D takes the drill.
TEST_F(DecimalPointTest, ARefusedNumberKeepsTheFocusWithItsTextSelected)
{
  saveBall("ball");
  openWindow("ball");
  ASSERT_TRUE(settled());
  auto* diameter = window().findChild<QDoubleSpinBox*>("burrDiameter");
  ASSERT_TRUE(diameter);
  auto* line = diameter->findChild<QLineEdit*>();
  const double before = diameter->value();
  // Refused at its end, as no such burr is sold, and while it is typed.
  for (const char* typed : {"3.7", "999"})
    for (const Qt::Key end : {Qt::Key_Return, Qt::Key_Tab})
    {
      SCOPED_TRACE(typed);
      diameter->setFocus();
      enterNumber(*diameter, typed, end);
      EXPECT_EQ(window().focusWidget(), diameter);
      EXPECT_EQ(diameter->value(), before);
      EXPECT_TRUE(line->selectedText().startsWith(QLocale::c().toString(before, 'f', 1)))
          << line->selectedText().toStdString();
      EXPECT_TRUE(window().statusBar()->currentMessage().contains(typed[0]))
          << window().statusBar()->currentMessage().toStdString();
      QTest::keyClick(window().focusWidget(), Qt::Key_D);
      EXPECT_FALSE(view().tool().GetDrillMode());
      EXPECT_EQ(window().focusWidget(), diameter);
    }
  // A number that is taken, or the second Return, goes on to the view.
  QTest::keyClick(diameter, Qt::Key_Return);
  EXPECT_EQ(window().focusWidget(), &view());
}

// Run once more under a locale with a decimal comma.
TEST_F(DecimalPointTest, NumbersHaveAPointAndATypedCommaBecomesOne)
{
  openWindow();
  EXPECT_STREQ(std::localeconv()->decimal_point, ".");
  auto* thrust = window().findChild<QDoubleSpinBox*>("thrust");
  ASSERT_TRUE(thrust);
  thrust->setValue(1.5);
  EXPECT_TRUE(thrust->text().startsWith("1.5")) << thrust->text().toStdString();
  for (const char* typed : {"2,5", "2.5"})
  {
    thrust->setValue(1.0);
    enterNumber(*thrust, typed);
    EXPECT_EQ(thrust->value(), 2.5) << typed;
  }
}
