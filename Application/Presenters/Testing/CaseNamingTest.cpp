#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

#include "petrous/Presenters/CaseNaming.h"

using namespace petrous;
using presenters::caseNameFrom;
using presenters::checkFreeCaseName;

TEST(CaseNaming, TakesTheFoldersOrFilesName)
{
  EXPECT_EQ(caseNameFrom("/data/Left ear"), "Left ear");
  EXPECT_EQ(caseNameFrom("/data/Left ear/"), "Left ear");
  EXPECT_EQ(caseNameFrom("ear.nii.gz"), "ear");
  EXPECT_EQ(caseNameFrom("EAR.NRRD"), "EAR");
  EXPECT_EQ(caseNameFrom("v1.2"), "v1.2");
  EXPECT_EQ(caseNameFrom("Ohr rechts \xC3\xBC"), "Ohr rechts \xC3\xBC");
}

TEST(CaseNaming, ShowsBlanksForUnderscoresAndAllElseAsItIs)
{
  EXPECT_EQ(presenters::shownName("facial_nerve"), "facial nerve");
  EXPECT_EQ(presenters::shownName("_A__b-c d_"), " A  b-c d ");
  EXPECT_EQ(presenters::shownName("Ohr_\xC3\xBC"), "Ohr \xC3\xBC");
  EXPECT_EQ(presenters::shownName(""), "");
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

TEST(CaseNaming, RefusesANameThatIsTakenOrTooLong)
{
  const auto folder = std::filesystem::temp_directory_path() /
                      ("petrous-case-naming-" + std::to_string(::getpid()));
  std::filesystem::remove_all(folder);
  library::Library library(folder);
  EXPECT_NO_THROW(checkFreeCaseName(library, "ear"));
  scene::Case value;
  value.name = "ear";
  value.ct.name = "ct";
  value.ct.geometry = core::GridGeometry({2, 2, 2}, Eigen::Vector3d::Ones(), {0.0, 0.0, 0.0});
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(value.ct.geometry));
  library.save(value);
  EXPECT_THROW(checkFreeCaseName(library, "ear"), core::InvalidParameter);
  EXPECT_NO_THROW(checkFreeCaseName(library, "ear 2"));
  EXPECT_NO_THROW(checkFreeCaseName(library, std::string(100, 'x')));
  EXPECT_THROW(checkFreeCaseName(library, std::string(101, 'x')), core::InvalidParameter);
  std::filesystem::remove_all(folder);
}
