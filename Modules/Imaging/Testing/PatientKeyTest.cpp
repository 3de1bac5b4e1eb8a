#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "petrous/Imaging/CasePatient.h"
#include "petrous/Imaging/PatientKey.h"

namespace petrous::imaging
{
namespace
{

TEST(PatientKey, SpellingsOfOneIdentityAgree)
{
  const PatientKey key = patientKey("A 17", "CLINIC", "M\xc3\xbcller^Anna Maria", "19630412");
  for (const char* name : {"M\xc3\x9cLLER^ANNA MARIA^^^", "m\xc3\xbcller anna  maria ",
                           "M\xc3\xbcller, Anna Maria", "M\xc3\xbcller^Anna Maria=\xe5\xb1\xb1"})
    EXPECT_TRUE(samePatient(key, patientKey(" a 17 ", "clinic", name, "19630412 "))) << name;
  EXPECT_TRUE(samePatient(key, patientKey("", "", "", ""))) << "states nothing";
  EXPECT_TRUE(samePatient(key, patientKey("A 17", "", "", "")));
  EXPECT_TRUE(patientKey("", "X", " ^^ ", "").empty());
  EXPECT_TRUE(patientKey("ANONYMOUS", "", "Anonymous", "").empty());
  EXPECT_FALSE(key.empty());
}

// Written for the patient of a case: two cases may be of one patient.
TEST(PatientKey, ThePatientOfACaseIsNobody)
{
  const std::string id = casePatientId(0x0123456789abcdefULL);
  EXPECT_EQ(id, "PETROUS-0123456789ABCDEF");
  EXPECT_TRUE(isCasePatientId(id));
  EXPECT_TRUE(patientKey(id, "", "Petrous^left ear", "").empty());
  EXPECT_TRUE(patientKey(" petrous-0123456789abcdef", "", "", "").empty());
  for (const char* other : {"PETROUS-0123", "PETROUS-0123456789ABCDEG", "0123456789ABCDEF"})
  {
    EXPECT_FALSE(isCasePatientId(other));
    EXPECT_FALSE(patientKey(other, "", "", "").empty()) << other;
  }
}

// Beside such an ID a name and a date of birth are somebody's all the same.
TEST(PatientKey, OfACaseKeepsWhatElseIsStated)
{
  const std::string one = casePatientId(1), two = casePatientId(2);
  const PatientKey key = patientKey(one, "", "Alpha^Ann", "19500101");
  EXPECT_EQ(key.id, 0U);
  EXPECT_EQ(key.name, patientKey("", "", "Alpha^Ann", "").name);
  EXPECT_FALSE(samePatient(key, patientKey(two, "", "Beta^Eve", "")));
  EXPECT_FALSE(samePatient(key, patientKey(two, "", "", "19990101")));
  EXPECT_TRUE(samePatient(key, patientKey("4711", "", "Alpha^Ann", "19500101")));
  const auto pseudonym = [](const std::string& id)
  { return patientKey(id, "", "Petrous^" + id, "").nameParts[0]; };
  EXPECT_NE(pseudonym(one), 0U);
  EXPECT_NE(pseudonym(one), pseudonym(two));
  EXPECT_EQ(pseudonym(one), patientKey(one, "", "PETROUS^another name", "").nameParts[0]);
  EXPECT_NE(patientKey(one, "", "Petrousson^Eve", "").name, 0U);
}

TEST(PatientKey, AnyThatDiffersMakesAnotherPatient)
{
  const PatientKey key = patientKey("17", "CLINIC", "Doe^Jane", "19630412");
  EXPECT_FALSE(samePatient(key, patientKey("18", "CLINIC", "Doe^Jane", "19630412")));
  EXPECT_FALSE(samePatient(key, patientKey("18", "", "Doe^Jane", "19630412")));
  EXPECT_FALSE(samePatient(key, patientKey("17", "CLINIC", "Doe^John", "19630412")));
  EXPECT_FALSE(samePatient(key, patientKey("17", "CLINIC", "Doe^Jane", "19630413")));
  EXPECT_FALSE(samePatient(key, patientKey("", "", "Roe", "")));
}

TEST(PatientKey, TellsWhatDiffers)
{
  const PatientKey key = patientKey("17", "CLINIC", "Doe^Jane", "19630412");
  const auto differing =
      [&key](const char* id, const char* issuer, const char* name, const char* date)
  {
    const auto found = differencesOf(key, patientKey(id, issuer, name, date));
    return std::string(found.id ? "i" : "") + (found.name ? "n" : "") +
           (found.birthDate ? "b" : "");
  };
  EXPECT_EQ(differing("17", "CLINIC", "DOE^JANE", "19630412"), "");
  EXPECT_EQ(differing("18", "CLINIC", "Doe^Jane", "19630412"), "i");
  EXPECT_EQ(differing("18", "OTHER", "Doe^Jane", "19630412"), "") << "another issuer's ID";
  EXPECT_EQ(differing("18", "", "Doe^John", ""), "in");
  EXPECT_EQ(differing("", "", "", "19630413"), "b");
  EXPECT_EQ(differing("18", "", "Doe^John", "19630413"), "inb");
  PatientDifferences both = differencesOf(key, patientKey("18", "", "", ""));
  both.join(differencesOf(key, patientKey("", "", "", "19630413")));
  EXPECT_TRUE(both.id && !both.name && both.birthDate);
}

TEST(PatientKey, KnowsEachWordOfTheNameAlone)
{
  const auto has = [](const PatientKey& key, const std::string& word)
  {
    const std::size_t part = namePartKey(word);
    return part != 0 &&
           std::find(key.nameParts.begin(), key.nameParts.end(), part) != key.nameParts.end();
  };
  const PatientKey key = patientKey("", "", "von M\xc3\xbcller-Lang^Anna Li^^Prof^Senior", "");
  for (const char* word : {"M\xc3\xbcller", "mueller", "MUELLER", "lang", "Anna"})
    EXPECT_TRUE(has(key, word)) << word;
  for (const char* word : {"von", "Li", "Prof", "Senior", "Mull", "17", ""})
    EXPECT_FALSE(has(key, word)) << word;
  EXPECT_FALSE(has(patientKey("", "", "Anonymous", ""), "anonymous"));
  EXPECT_FALSE(has(patientKey("", "", "Phantom^Petrous", ""), "petrous"));
}

// As keyboards without these letters write names, and file names joined ones.
TEST(PatientKey, KnowsNamesWithoutAccentsAndJoined)
{
  const auto has = [](const std::string& name, const std::string& word)
  {
    const PatientKey key = patientKey("", "", name, "");
    const auto isIn = [](const auto& parts, std::size_t part)
    { return std::find(parts.begin(), parts.end(), part) != parts.end(); };
    return isOfName(word,
                    [&](std::size_t part)
                    {
                      EXPECT_NE(part, 0U);
                      return isIn(key.nameParts, part) || isIn(key.foldedParts, part);
                    });
  };
  for (const auto& [name, word] : {
           std::pair("M\u00fcller-K\u00f6nigsmark^Hildegunde", "Muller"),
           {"M\u00fcller-K\u00f6nigsmark^Hildegunde", "konigsmark"},
           {"M\u00fcller-K\u00f6nigsmark^Hildegunde", "MuellerKoenigsmark"},
           {"Lef\u00e8vre^H\u00e9l\u00e8ne", "Lefevre"},
           {"LEFEVRE^HELENE", "Lef\u00e8vre"},
           {"Mu\u00f1oz Garc\u00eda^Jos\u00e9", "Munoz"},
           {"Mu\u00f1oz Garc\u00eda^Jos\u00e9", "JoseGarcia"},
           {"\u0141ukasiewicz^\u017baneta", "Lukasiewicz"},
           {"\u0141ukasiewicz^\u017baneta", "\u0142ukasiewicz"},
           {"\u00c5str\u00f6m^G\u00f6ran", "Astrom"},
           {"\u00c5str\u00f6m^G\u00f6ran", "Goran"},
           {"van der Meer^Jan-Willem", "vanderMeer"},
           {"van der Meer^Jan-Willem", "JanWillem"},
           {"MUELLER^HANS", "MuellerHans"},
           {"MUELLER^HANS", "HansM\u00fcller"},
           {"MUELLER^HANS", "Muller"},
           {"Muller^Hans", "Mu\u0308ller"}, // decomposed, as of file names
           {"Nguy\u1ec5n^\u00c1nh", "Nguyen"},
           {"S\u00f8rensen^\u00d0uro", "Sorensen"},
           {"Stra\u00dfmann^\u00de\u00f3r", "Strassmann"},
           {"Stra\u00dfmann^\u00de\u00f3r", "Thor"},
           {"O'Brien^Pat", "OBrien"},
           {"Li^Wei", "LiWei"},
       })
    EXPECT_TRUE(has(name, word)) << name << ": " << word;
  for (const auto& [name, word] : {
           std::pair("M\u00fcller^Jane", "janet"),
           {"M\u00fcller^Jane T", "janet"}, // an initial behind says nothing
           {"M\u00fcller^Jane", "m\u00fchle"},
           {"M\u00fcller^Jane", "Mull"},
           {"M\u00fcller^Jane", ""},
           {"van der Meer^Jan", "vander"}, // particles alone
           {"A B^C", "abc"},
           {"Li^Wei", "li"},
       })
    EXPECT_FALSE(has(name, word)) << name << ": " << word;
}

// Particles do not count, and no text has the key of a part that is no name by itself.
TEST(PatientKey, FoldsTheSpellingsOfAPart)
{
  EXPECT_EQ(foldedPartKey("M\u00fcller"), foldedPartKey("MUELLER"));
  EXPECT_EQ(foldedPartKey("M\u00fcller"), foldedPartKey("muller"));
  EXPECT_NE(foldedPartKey("M\u00fcller"), foldedPartKey("Moller"));
  EXPECT_EQ(foldedPartKey("van"), 0U);
  EXPECT_EQ(foldedPartKey(""), 0U);
  EXPECT_NE(foldedPartKey("Li"), 0U);
  EXPECT_NE(foldedPartKey("Li"), patientKey("Li", "", "", "").id);
  EXPECT_EQ(patientKey("", "", "van der Meer^Jan", "").joinedName,
            patientKey("", "", "VANDERMEER^JAN", "").joinedName);
  for (const char* nobody : {"Anonymous", "Phantom^Petrous", "Phantom^17"})
  {
    const PatientKey key = patientKey("", "", nobody, "");
    EXPECT_EQ(key.joinedName, 0U) << nobody;
    EXPECT_EQ(key.foldedParts, PatientKey().foldedParts) << nobody;
  }
}

TEST(PatientKey, IdsOfTwoIssuersAreNotCompared)
{
  const PatientKey key = patientKey("17", "CLINIC", "Doe^Jane", "19630412");
  EXPECT_TRUE(samePatient(key, patientKey("4711", "OTHER", "Doe^Jane", "19630412")));
  EXPECT_FALSE(samePatient(key, patientKey("17", "OTHER", "Roe^Jane", "19630412")));
}

} // namespace
} // namespace petrous::imaging
