#include "petrous/Presenters/Phrasebook.h"

#include <map>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Presenters/CaseStamp.h"

using petrous::presenters::earDoubt;
using petrous::presenters::germanPhraseList;
using petrous::presenters::germanPhrases;
using petrous::presenters::Phrasebook;
using petrous::presenters::sideDoubt;
using petrous::presenters::withDecimalCommas;
using petrous::presenters::withGroupedDigits;
namespace core = petrous::core;
namespace scene = petrous::scene;

namespace
{

const Phrasebook& few()
{
  static const Phrasebook kBook({
      {"%#1 slices are missing; copy the series again",
       "%#1 Schichten fehlen; kopieren Sie die Serie neu"},
      {"%#1 slice is missing; copy the series again",
       "%#1 Schicht fehlt; kopieren Sie die Serie neu"},
      {"'%1' cannot be sent: %~2", "„%1“ lässt sich nicht senden: %~2"},
      {"%1 lies %#2 mm from %3", "%3 ist von %1 um %#2 mm entfernt"},
      {"the disk is full", "der Datenträger ist voll"},
      {"the disk of %1 is full of old cases", "der Datenträger von %1 ist voll alter Fälle"},
      {"nothing", "nichts"},
      {"Repaired: slices were shifted.", "Repariert: Schichten wurden verschoben."},
      {"%#1 left out", "%#1 blieben weg"},
      {"%#1 structures read", "%#1 Strukturen gelesen"},
  });
  return kBook;
}

std::string filled(std::string phrase, const std::string& value)
{
  for (std::size_t at = 0; (at = phrase.find('%', at)) != std::string::npos;)
  {
    std::size_t end = at + 1;
    if (end < phrase.size() && (phrase[end] == '~' || phrase[end] == '#'))
      ++end;
    const std::size_t digits = end;
    while (end < phrase.size() && phrase[end] >= '0' && phrase[end] <= '9')
      ++end;
    if (end == digits)
    {
      ++at;
      continue;
    }
    const std::string one = value + phrase.substr(digits, end - digits);
    phrase.replace(at, end - at, one);
    at += one.size();
  }
  return phrase;
}

} // namespace

TEST(Phrasebook, PutsNamesAndNumbersWhereTheOtherLanguageHasThem)
{
  EXPECT_EQ(few().text("cochlea lies 1.25 mm from burr"),
            "burr ist von cochlea um 1.25 mm entfernt");
  EXPECT_EQ(few().text("3 slices are missing; copy the series again"),
            "3 Schichten fehlen; kopieren Sie die Serie neu");
  EXPECT_EQ(few().text("1 slice is missing; copy the series again"),
            "1 Schicht fehlt; kopieren Sie die Serie neu");
}

TEST(Phrasebook, DigitsAreGroupedFromTenThousandOn)
{
  for (const auto& [text, grouped] :
       std::map<std::string, std::string>{{"", ""},
                                          {"9999", "9999"},
                                          {"60000 /min", "60\u202f000 /min"},
                                          {"-123456.654321 mm", "-123\u202f456.654321 mm"},
                                          {"0,123456", "0,123456"},
                                          {"1234567 x 12345", "1\u202f234\u202f567 x 12\u202f345"}})
    EXPECT_EQ(withGroupedDigits(text), grouped);
}

TEST(Phrasebook, TheLinesOfAListAreTranslatedBehindTheirDashes)
{
  EXPECT_EQ(
      Phrasebook({{"the note stays", "die Notiz bleibt"}, {"the date stays", "das Datum bleibt"}})
          .text("Ear:\n  - the note stays\n  - ear\n"),
      "Ear:\n  - die Notiz bleibt\n  - ear\n");
}

TEST(Phrasebook, APhraseInAPhraseIsTranslatedAndANameThatReadsAsOneIsNot)
{
  EXPECT_EQ(few().text("'nothing' cannot be sent: the disk is full"),
            "„nothing“ lässt sich nicht senden: der Datenträger ist voll");
  EXPECT_EQ(few().text("'a' cannot be sent: nothing"), "„a“ lässt sich nicht senden: nichts");
}

TEST(GermanPhrases, NameAMarkAndTheStructureThatAWallIsMeasuredTo)
{
  EXPECT_EQ(germanPhrases().text("mark"), "Marke");
  EXPECT_EQ(germanPhrases().text("to 'air cells'"), "zu „air cells“");
  EXPECT_EQ(germanPhrases().text("to 'air cells', which was removed"),
            "zu „air cells“, das entfernt wurde");
}

TEST(GermanPhrases, NameTheSideInGermanAndNoPartOfTheCaseByAnotherName)
{
  scene::Case value;
  value.ct.geometry =
      core::GridGeometry({10, 10, 10}, {1.0, 1.0, 1.0}, {20.0, 0.0, 0.0}); // on the left
  value.description.side = scene::Side::Right;
  for (const std::string& english :
       {sideDoubt(value), earDoubt(value, scene::Side::Left), earDoubt(value, scene::Side::Right)})
  {
    const std::string german = germanPhrases().text(english);
    for (const char* word : {"left", "right", "stated", "patient's"})
      EXPECT_EQ(german.find(word), std::string::npos) << german;
    EXPECT_NE(german.find("rechts"), std::string::npos) << german;
  }
  const std::string name = "MR 'left, right' is not in the case";
  EXPECT_EQ(Phrasebook({{"MR '%1' is not in the case", "Die MR „%1“ ist nicht im Fall"},
                        {"left, right", "links, rechts"}})
                .text(name),
            "Die MR „left, right“ ist nicht im Fall");
}

// The number of parts that are looked up, not a time: this took minutes.
TEST(GermanPhrases, ALongListIsLookedUpAtOnce)
{
  std::string list = "Repaired: slices 1";
  for (int n = 2; n < 400; ++n)
    list += ", " + std::to_string(n);
  std::string names = "ab";
  for (int n = 0; n < 450; ++n)
    names += ", ab";
  EXPECT_FALSE(germanPhrases().text(list + " were interpolated").empty());
  EXPECT_EQ(germanPhrases().text(names), names);
}

TEST(Phrasebook, ThePhraseWithTheMostWordsOfItsOwnIsTaken)
{
  EXPECT_EQ(few().text("the disk of node 7 is full of old cases"),
            "der Datenträger von node 7 ist voll alter Fälle");
}

TEST(Phrasebook, ASentenceBeginsWithACapital)
{
  const Phrasebook book({{"the fits of '%1' agree", "über „%1“ sind sich die Anpassungen einig"},
                         {"The disk is full", "Die Platte ist voll"}});
  EXPECT_EQ(book.text("The fits of 'T2' agree."), "Über „T2“ sind sich die Anpassungen einig.");
  EXPECT_EQ(book.text("the fits of 'T2' agree"), "über „T2“ sind sich die Anpassungen einig");
  EXPECT_EQ(book.text("The disk is full"), "Die Platte ist voll");
  EXPECT_FALSE(book.find("the disk is full")) << "no sentence of the program";
}

TEST(Phrasebook, PartsOfATextAreFoundAndWhatIsNoPhraseStays)
{
  EXPECT_EQ(few().text("/data/a b.nrrd: the disk is full"),
            "/data/a b.nrrd: der Datenträger ist voll");
  EXPECT_EQ(few().text("3 structures read, 2 left out."), "3 Strukturen gelesen, 2 blieben weg.");
  EXPECT_EQ(few().text("Repaired: slices were shifted. the disk is full"),
            "Repariert: Schichten wurden verschoben. der Datenträger ist voll");
  EXPECT_EQ(few().text("the disk is full\nConnection reset by peer"),
            "der Datenträger ist voll\nConnection reset by peer");
  EXPECT_FALSE(few().find("Connection reset by peer"));
  EXPECT_FALSE(few().find("no structures read")); // no number
  EXPECT_EQ(few().text("nothing: the disk is full"), "nothing: der Datenträger ist voll");
  EXPECT_FALSE(few().find(""));
}

// The German of each, with its own values, and of no other.
TEST(GermanPhrases, HaveTheWordsThatStandForNoNumber)
{
  for (const auto& property : petrous::appearance::kStructureProperties)
    if (property.off && property.isNumber())
    {
      EXPECT_TRUE(germanPhrases().find(property.off)) << property.off;
    }
}

TEST(GermanPhrases, EachIsFoundAsItself)
{
  ASSERT_GT(germanPhraseList().size(), 1000U);
  std::set<std::string> seen;
  for (const auto& [english, german] : germanPhraseList())
  {
    EXPECT_TRUE(seen.insert(english).second) << english;
    EXPECT_EQ(germanPhrases().text(filled(english, "7")), filled(german, "7")) << english;
  }
}

// As the segment editor puts them together: sentences on lines of their own.
TEST(GermanPhrases, HaveEveryDoubtOfATracedNerve)
{
  const std::pair<std::string, std::string> guesses[] = {
      {"The scan does not resolve it along 0.9 mm of 22.0 mm: there the path is a guess between "
       "your points.",
       "Die Aufnahme l\u00f6st sie auf 0.9 mm von 22.0 mm nicht auf: Dort ist der Verlauf eine "
       "Vermutung zwischen Ihren Punkten."},
      {"The scan does not resolve it along 0.9 mm of 22.0 mm: there the path and its radius are a "
       "guess between your points.",
       "Die Aufnahme l\u00f6st sie auf 0.9 mm von 22.0 mm nicht auf: Dort sind Verlauf und Radius "
       "eine Vermutung zwischen Ihren Punkten."}};
  const std::pair<std::string, std::string> before[] = {
      {"", ""},
      {"The points seem not to be in their order along the structure: 1, 3, 2 would make a much "
       "shorter line.\n",
       "Die Punkte scheinen nicht in ihrer Reihenfolge entlang der Struktur zu liegen: 1, 3, 2 "
       "erg\u00e4be eine viel k\u00fcrzere Linie.\n"},
      {"Where it is thinner than the voxels it is drawn one voxel wide, so that it has no gap: 7 "
       "of "
       "its 90 voxels, which its volume counts whole.\n",
       "Wo sie d\u00fcnner als die Voxel ist, wird sie ein Voxel breit gezeichnet, damit sie keine "
       "L\u00fccke hat: 7 ihrer 90 Voxel, die ihr Volumen ganz z\u00e4hlt.\n"}};
  const std::pair<std::string, std::string> after[] = {
      {"", ""},
      {"\nIts radius of 0.6 mm is the usual one of its name, and nothing that the image shows.",
       "\nIhr Radius von 0.6 mm ist der zu ihrem Namen \u00fcbliche; das Bild zeigt ihn nicht."}};
  for (const auto& [english, german] : guesses)
    for (const auto& [englishBefore, germanBefore] : before)
      for (const auto& [englishAfter, germanAfter] : after)
        EXPECT_EQ(germanPhrases().text(englishBefore + english + englishAfter),
                  germanBefore + german + germanAfter);
  // Each reason for which a stretch is not resolved.
  for (const char* reason :
       {"it does not stand out from the noise", "it is narrower than two voxels",
        "what is seen is wider than the structure can be",
        "the path runs through air or bone, not through a nerve",
        "the path leads through something of another intensity",
        "a quarter of its circumference or more has no wall, as at an edge",
        "the path is a long detour between two points; set another one between them",
        "what is seen is too short a piece of it"})
  {
    const std::string text =
        germanPhrases().text("Not resolved from 0.0 to 0.9 mm: " + std::string(reason) + ".");
    EXPECT_EQ(text.rfind("Nicht aufgel\u00f6st von 0.0 bis 0.9 mm: ", 0), 0U) << text;
    for (const char* word : {" it ", " is ", " the ", " not ", " than ", " of "})
      EXPECT_EQ(text.find(word), std::string::npos) << text;
  }
}

TEST(GermanPhrases, AreThoseOfMessagesAsTheyAreShown)
{
  const std::pair<const char*, const char*> messages[] = {
      {"/media/ct/7.dcm is cut short; copy it again from where it came from",
       "/media/ct/7.dcm ist abgeschnitten; kopieren Sie es noch einmal vom Ursprung"},
      {"Repaired: slices 3 to 5 of 120 are missing and were interpolated between neighbours, up to "
       "1.25 mm from what was measured; small structures may be absent there.",
       "Repariert: Schichten 3 bis 5 von 120 fehlen und wurden zwischen Nachbarn interpoliert, bis "
       "zu 1.25 mm vom Gemessenen; kleine Strukturen können dort fehlen."},
      {"facial nerve touched (± 0.3 mm); injured, under 0.01 mm³\nsigmoid sinus 0.8 mm ± 0.3\nand "
       "2 "
       "more",
       "facial nerve berührt (± 0.3 mm); verletzt, unter 0.01 mm³\nsigmoid sinus 0.8 mm ± 0.3\nund "
       "2 "
       "weitere"},
      {"registered by landmarks, refined by mutual information, good, error 0.24 mm (p95) at the "
       "middle of 'incus', not signed off",
       "registriert: Landmarken, verfeinert durch Transinformation, gut, Fehler 0.24 mm (p95) in "
       "der "
       "Mitte von „incus“, nicht freigegeben"},
      {"registered by mutual information, good, error 0.32 mm (p95) at the centre of the CT, not "
       "signed off",
       "registriert: Transinformation, gut, Fehler 0.32 mm (p95) in der Mitte des CT, nicht "
       "freigegeben"},
      {"Repeated fits agree; 95 of 100 errors are below 0.32 mm.",
       "Wiederholte Anpassungen stimmen überein; 95 von 100 Fehlern liegen unter 0.32 mm."},
      {"hide 3 parts", "3 Teile ausblenden"},
      {"removal of left lateral semicircular canal",
       "Entfernen von left lateral semicircular canal"},
      {"view 'from behind'", "Ansicht „from behind“"},
      {"masking", "Maskierung"},
      {"about 20 s left", "noch etwa 20 s"},
      {"about 2 min left", "noch etwa 2 min"},
      {"about 1 h 10 min left", "noch etwa 1 h 10 min"},
      {"MR 'T2' is not registered with the CT; register it first",
       "das MR „T2“ ist nicht mit dem CT registriert; registrieren Sie es erst"},
      {"tube: the radius must lie within 0.1 to 5 mm, not 7",
       "Röhre: der Radius muss in 0.1 bis 5 mm liegen, nicht 7"},
      {"The tool has no result: region: give a point inside the structure",
       "Das Werkzeug hat kein Ergebnis: Bereich: geben Sie einen Punkt in der Struktur"},
      {"/x/labels.nrrd: does not say which side of the patient is left; its axes were taken as "
       "LPS, "
       "as asked",
       "/x/labels.nrrd: sagt nicht, welche Seite des Patienten links ist; die Achsen wurden als "
       "LPS "
       "genommen, wie gewünscht"},
      {"/x/materials.json: material 'bone': 'friction' must be above 0, it is -0.5",
       "/x/materials.json: Material „bone“: „friction“ muss über 0 liegen, es ist -0.5"},
      {"/x/materials.json: there is no material 'enamel'; there are cellular-bone, nerve",
       "/x/materials.json: es gibt kein Material „enamel“; es gibt cellular-bone, nerve"},
      {"3 structures read, 1 left out, 2 not read",
       "3 Strukturen gelesen, 1 blieben weg, 2 nicht gelesen"},
  };
  for (const auto& [english, german] : messages)
    EXPECT_EQ(germanPhrases().text(english), german);
}

TEST(DecimalCommas, AreThoseOfNumbersAlone)
{
  const std::pair<const char*, const char*> texts[] = {
      {"0.25 mm", "0,25 mm"},
      {"-0.5, 1.5 and 2.", "-0,5; 1,5 and 2."},
      {"ends at 3.5. Next", "ends at 3,5. Next"},
      {"UID 1.2.840, version 9.1.0", "UID 1.2.840, version 9.1.0"},
      {"scan 1.5.nii in /data/2.5/ct", "scan 1.5.nii in /data/2.5/ct"},
      {"MR \u201eT1 2.0\u201c of 2.0 mm", "MR \u201eT1 2.0\u201c of 2,0 mm"},
      {"T2-0.5", "T2-0.5"},
      {"/data/InnerEar 0.6 Hr69/a.dcm: 0.5 mm", "/data/InnerEar 0.6 Hr69/a.dcm: 0,5 mm"},
      {"InnerEar 0.6 Hr69/a.dcm: 0.5 mm", "InnerEar 0.6 Hr69/a.dcm: 0,5 mm"},
      {"1.5 mm: in /data/CT 0.6 mm/x.nii", "1,5 mm: in /data/CT 0.6 mm/x.nii"},
      {"0.5 mm / 1.5 mm: both", "0,5 mm / 1,5 mm: both"},
      {"needs TLS 1.2 and 1.5 s", "needs TLS 1.2 and 1,5 s"},
  };
  for (const auto& [text, german] : texts)
    EXPECT_EQ(withDecimalCommas(text), german);
}
