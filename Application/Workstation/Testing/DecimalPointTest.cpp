#include <clocale>

#include <QDoubleSpinBox>
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
    box.selectAll();
    QTest::keyClicks(&box, typed);
    QTest::keyClick(&box, Qt::Key_Enter);
    EXPECT_EQ(box.value(), 300.0) << typed;
    EXPECT_TRUE(box.property("refused").toBool()) << typed;
  }
  box.selectAll();
  QTest::keyClicks(&box, "1200");
  QTest::keyClick(&box, Qt::Key_Enter);
  EXPECT_EQ(box.value(), 1200.0);
  EXPECT_FALSE(box.property("refused").toBool());
}

TEST_F(DecimalPointTest, SaysWhyInTheStatusBarAndTheMarkGoes)
{
  openWindow();
  auto* exposure = window().findChild<QDoubleSpinBox*>("exposure");
  ASSERT_TRUE(exposure);
  const auto type = [exposure](const char* text)
  {
    exposure->selectAll();
    QTest::keyClicks(exposure, text);
    QTest::keyClick(exposure, Qt::Key_Enter);
  };
  type("9");
  EXPECT_EQ(exposure->value(), 0.0);
  EXPECT_EQ(window().statusBar()->currentMessage(), "9 is above the most, 4 EV");
  EXPECT_TRUE(exposure->property("refused").toBool()) << "though the field was left";
  type("-77");
  EXPECT_EQ(window().statusBar()->currentMessage(), "-7 is below the least, -4 EV");
  type("1,2,3");
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("is not possible here"))
      << window().statusBar()->currentMessage().toStdString();
  EXPECT_TRUE(exposure->property("refused").toBool());
  EXPECT_TRUE(waitFor([exposure] { return !exposure->property("refused").toBool(); }));
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
    thrust->selectAll();
    QTest::keyClicks(thrust, typed);
    QTest::keyClick(thrust, Qt::Key_Enter);
    EXPECT_EQ(thrust->value(), 2.5) << typed;
  }
}
