#include <clocale>

#include <QDoubleSpinBox>
#include <QTest>

#include "GuiTest.h"

using namespace petrous;
using namespace petrous::workstation;

class DecimalPointTest : public GuiTest
{
};

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
