#include <gtest/gtest.h>

#include "petrous/Presenters/CaseNaming.h"

using namespace petrous;
using presenters::caseNameFrom;

TEST(CaseNaming, TakesTheFoldersOrFilesName)
{
  EXPECT_EQ(caseNameFrom("/data/Left ear"), "Left ear");
  EXPECT_EQ(caseNameFrom("/data/Left ear/"), "Left ear");
  EXPECT_EQ(caseNameFrom("ear.nii.gz"), "ear");
  EXPECT_EQ(caseNameFrom("EAR.NRRD"), "EAR");
  EXPECT_EQ(caseNameFrom("v1.2"), "v1.2");
  EXPECT_EQ(caseNameFrom("Ohr rechts \xC3\xBC"), "Ohr rechts \xC3\xBC");
}

TEST(CaseNaming, AlwaysGivesANameThatACaseMayHave)
{
  for (const std::string& odd :
       {std::string("..."), std::string("-x"), std::string("a:b*c?"), std::string(" . "),
        std::string("a\tb"), std::string("\xff\xfe"), std::string(300, 'x'),
        std::string(89, 'x') + "\xC3\xBC\xC3\xBC", std::string("a\xC3"), std::string("--.nrrd"),
        std::string("/"), std::string("\xed\xa0\x80 ear"), std::string("\xc0\xaf ear"),
        std::string("\xe0\x80\xaf ear")})
  {
    const std::string name = caseNameFrom(odd);
    EXPECT_NO_THROW(scene::checkCaseName(name)) << odd;
  }
  EXPECT_EQ(caseNameFrom("..."), "case");
  EXPECT_EQ(caseNameFrom("-x"), "x");
}
