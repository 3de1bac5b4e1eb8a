#include "LabelTable.h"
#include "LabelNames.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "TestFiles.h"
#include "petrous/Imaging/LabelFile.h"

namespace petrous::imaging
{
namespace
{

using Reason = FileError::Reason;

std::string entriesOf(const LabelTable& table)
{
  std::string text;
  for (const auto& segment : table.segments)
  {
    text += std::to_string(segment.index) + ":" + segment.name + "(";
    for (const float channel : segment.color)
      text += std::to_string(static_cast<int>(channel * 255.0F + 0.5F)) + " ";
    text.back() = ')';
    text += ";";
  }
  return text;
}

std::string entriesIn(const std::string& text)
{
  const LabelTable table = parseTable(text);
  EXPECT_TRUE(table.problems.empty()) << table.problems.front();
  return entriesOf(table);
}

constexpr const char* kTwo = "1:facial nerve(255 128 0);7:cochlea(0 51 255);";

} // namespace

TEST(LabelTable, ReadsTheSameEntriesInEveryFormat)
{
  EXPECT_EQ(entriesIn("# Color table file a.ctbl\n# 3 values\n0 Background 0 0 0 0\n"
                      "1 \"facial nerve\" 255 128 0 255\n7 cochlea 0 51 255 255\n"),
            kTwo);
  EXPECT_EQ(entriesIn("1 facial nerve 255 128 0 255\r\n7 cochlea 0 51 255\r\n"), kTwo)
      << "3 D Slicer, unquoted, with the line ends of Windows";
  EXPECT_EQ(entriesIn("#No. Label Name:   R   G   B   A\n\n0   Unknown  0 0 0 0\n"
                      "1   facial nerve     255 128 0   0\n7 cochlea 0 51 255 0\n"
                      "999999  SUSPICIOUS  255 100 100 0\n"),
            kTwo)
      << "FreeSurfer";
  EXPECT_EQ(entriesIn("################\n# ITK-SnAP Label Description File\n"
                      "    0     0    0    0        0  0  0    \"Clear Label\"\n"
                      "    1   255  128    0        1  1  1    \"facial nerve\"\n"
                      "    7     0   51  255        1  1  1    \"cochlea\"\n"),
            kTwo);
  EXPECT_EQ(entriesIn("index,name,r,g,b\n1,facial nerve,255,128,0\n7,\"cochlea\",0,51,255\n"),
            kTwo);
  EXPECT_EQ(entriesIn("\xef\xbb\xbf"
                      "Name;Color;Opacity;Label\r\nfacial nerve;#ff8000;0,5;1\r\n"
                      "cochlea;#0033FF;1;7\r\n;;;\r\n"),
            kTwo)
      << "as a German spreadsheet writes it";
  EXPECT_EQ(entriesIn("value\tlabel\tred\tgreen\tblue\n1\tfacial nerve\t1\t0,502\t0\n"
                      "7.0\tcochlea\t0\t0,2\t1\n"),
            kTwo)
      << "colours from 0 to 1, with a decimal comma";
  EXPECT_EQ(entriesIn("LabelValue,Name,Color_R,Color_G,Color_B,Color_A,SegmentedProperty\n"
                      "1,facial nerve,255,128,0,255,\n7,cochlea,0,51,255,255,\n"),
            kTwo)
      << "3D Slicer's newer tables";
  EXPECT_EQ(entriesIn("1,facial nerve,255,128,0\n7,cochlea,0,51,255\n"), kTwo) << "no header";
  EXPECT_EQ(entriesIn("{\"1\": \"facial nerve\", \"7\": \"cochlea\"}"),
            "1:facial nerve(0 0 0);7:cochlea(0 0 0);");
  EXPECT_EQ(entriesIn("{\"channel_names\": {\"0\": \"CT\"}, \"labels\": {\"background\": 0, "
                      "\"cochlea\": 7, \"facial nerve\": 1}}"),
            "1:facial nerve(0 0 0);7:cochlea(0 0 0);");
}

TEST(LabelTable, KeepsNamesAsTheyAreWritten)
{
  EXPECT_EQ(entriesIn("index;name\n3;\"sinus, \"\"sigmoid\"\"; left\"\n"),
            "3:sinus, \"sigmoid\"; left(0 0 0);");
  EXPECT_EQ(entriesIn("3 rib_left_7 1 2 3 255\n4 rib left 8 1 2 3 255\n"),
            "3:rib_left_7(1 2 3);4:rib left 8(1 2 3);");
  const LabelTable latin = parseTable("index;name\n3;Hirnh\xe4ute\n");
  EXPECT_EQ(entriesOf(latin), "3:Hirnh\xc3\xa4ute(0 0 0);");
  ASSERT_EQ(latin.notes.size(), 1U);
  EXPECT_NE(latin.notes[0].find("Latin-1"), std::string::npos);
}

TEST(LabelTable, ANumberThatEndsANameIsNoColour)
{
  const char* const kNumbered = "1:nerve 7(255 0 0);2:nerve 8(0 0 255);3:cochlea(7 8 9);";
  EXPECT_EQ(entriesOf(parseTable("1 nerve 7 255 0 0\n2 nerve 8 0 0 255\n3 cochlea 7 8 9\n")),
            kNumbered)
      << "no column of opacity, as an entry without a number shows";
  EXPECT_EQ(entriesOf(parseTable("1 nerve 7 255 0 0\n2 nerve 8 0 0 255\n")),
            "1:nerve 7(255 0 0);2:nerve 8(0 0 255);");
  EXPECT_EQ(entriesIn("# index name r g b\n1 nerve 7 255 0 0\n2 nerve 300 9 0 9\n"),
            "1:nerve 7(255 0 0);2:nerve 300(9 0 9);");
  EXPECT_EQ(entriesIn("1 \"nerve 7\" 255 0 0\n2 \"nerve 8\" 0 0 255\n3 \"cochlea\" 7 8 9\n"),
            kNumbered);
  EXPECT_EQ(entriesIn("0 black 0 0 0 0\n1 nerve 7 255 0 0 255\n2 nerve 8 0 0 255 255\n"
                      "3 cochlea 7 8 9 255\n"),
            kNumbered)
      << "3D Slicer";
  EXPECT_EQ(entriesIn("#No. Label Name: R G B A\n1 nerve 7 255 0 0 0\n2 nerve 8 0 0 255 0\n"
                      "3 cochlea 7 8 9 0\n"),
            kNumbered)
      << "FreeSurfer";
  EXPECT_EQ(entriesIn("1 255 0 0 1 1 1 \"nerve 7\"\n2 0 0 255 1 1 1 \"nerve 8\"\n"
                      "3 7 8 9 1 1 1 \"cochlea\"\n"),
            kNumbered)
      << "ITK-SNAP";
  for (const char delimiter : {',', '\t', ';'})
  {
    std::string rows = "1,nerve 7,255,0,0\n2,nerve 8,0,0,255\n3,cochlea,7,8,9\n";
    std::replace(rows.begin(), rows.end(), ',', delimiter);
    EXPECT_EQ(entriesIn(rows), kNumbered) << delimiter;
  }
  // Opacity and no number: colours of a whole table with an opacity stay what they are.
  EXPECT_EQ(entriesIn("1 nerve 7 8 9 255\n2 cochlea 10 11 12 255\n"),
            "1:nerve(7 8 9);2:cochlea(10 11 12);");
  const LabelTable table = parseTable("1 nerve 7 255 0 0\n3 cochlea 7 8 9\n");
  ASSERT_EQ(table.notes.size(), 1U);
  EXPECT_NE(table.notes[0].find("'nerve 7'"), std::string::npos) << table.notes[0];
}

TEST(LabelTable, ReadsQuotesWithinANameOfItkSnap)
{
  EXPECT_EQ(entriesIn("1 1 2 3 1 1 1 \"the \\\"big\\\" nerve\"\n"
                      "2 1 2 3 1 1 1 \"the \"\"other\"\" nerve\"\n"
                      "3 1 2 3 1 1 1 \"a\"b\"\n4 1 2 3 1 1 1 \"C:\\\\scan\\\"\n"),
            "1:the \"big\" nerve(1 2 3);2:the \"other\" nerve(1 2 3);3:a\"b(1 2 3);"
            "4:C:\\scan\\(1 2 3);");
}

// As spreadsheets write a line break within a cell; the lines are counted on.
TEST(LabelTable, ReadsQuotedCellsOfSeveralLines)
{
  for (const std::string end : {"\n", "\r\n"})
  {
    EXPECT_EQ(entriesIn("index,name,r,g,b" + end + "1,\"facial" + end +
                        "nerve, \"\"left\"\"\",1,2,3" + end + "2,stapes,4,5,6" + end),
              "1:facial nerve, \"left\"(1 2 3);2:stapes(4 5 6);");
    EXPECT_EQ(entriesIn("1;\"a" + end + end + "b\";1;2;3" + end), "1:a  b(1 2 3);");
  }
  const TestFolder folder;
  const auto refused = [&folder](const std::string& text)
  { return refusalOf([&] { readLabelTable(putFile(folder / "names.csv", text)); }); };
  expectRefused(refused("index,name\n1,\"a\nb\"\n2.5,c\n"), Reason::Unreadable,
                "line 4 gives an index");
  expectRefused(refused("index,name\n1,incus\n2,\"stapes\n3,malleus\n"), Reason::Unreadable,
                "line 3 opens a quote that is not closed");
  // The quote that opens another name does not close it.
  expectRefused(refused("1,\"facial,255,0,0\n2,chorda,0,255,0\n3,incus,0,0,255\n"
                        "4,\"stapes\",9,9,9\n"),
                Reason::Unreadable, "line 1 opens a quote that is not closed");
}

TEST(LabelTable, RefusesWithTheLineThatIsWrong)
{
  const TestFolder folder;
  const auto refused = [&folder](const std::string& text)
  { return refusalOf([&] { readLabelTable(putFile(folder / "names.csv", text)); }); };
  const std::pair<const char*, const char*> wrong[] = {
      {"index,name\n1,incus\n2,stapes\n1,malleus\n", "line 4 gives index 1 a second name"},
      {"index,name\n1,incus\n\n-2,stapes\n", "line 4 gives the index -2"},
      {"index,name\n1,incus\n65536,stapes\n", "line 3 gives the index 65536"},
      {"index,name\n1,incus\ntwo,stapes\n", "line 3 gives an index that is not a whole number"},
      {"index,name\n1,incus\n2.5,stapes\n", "line 3 gives an index that is not a whole number"},
      {"index,name\n1,incus\n2,\n", "line 3 gives index 2 no name"},
      {"index,name,color\n1,incus,#ff0000\n2,stapes,crimson\n", "line 3 gives a colour"},
      {"index,name,r,g,b\n1,incus,1,2,3\n2,stapes,0,256,0\n", "line 3 gives a colour"},
      {"id,label,name\n1,2,right\n2,1,left\n",
       "line 2 gives the index 1 in column 'id' and 2 in column 'label'"},
      {"index,value,name\n1,1,left\n2,7,right\n",
       "line 3 gives the index 2 in column 'index' and 7 in column 'value'"},
      {"# c\n1 incus 1 2 3 255\n1 stapes 1 2 3 255\n", "line 3 gives index 1 a second name (the "
                                                       "first is in line 2)"},
      {"1 incus 1 2 3 255\n-4 stapes 1 2 3 255\n", "line 2 gives the index -4"},
      {"1 incus 1 2 3 255\nstapes 1 2 3 255\n", "line 2 does not start with an index"},
      {"{\"incus\": 1, \"stapes\": 1}", "gives index 1 a second name"},
      {"{\n\"incus\": 1,\n\"incus\": 2}", "line 3 gives 'incus' a second time"},
      {"{\"1\": \"incus\",\n\n\"1\": \"stapes\"}", "line 3 gives '1' a second time"},
      {"{\"x\": {\"1\": 1}, \"labels\": {\"incus\": 1,\n\"incus\": 1}}",
       "line 2 gives 'incus' a second time"},
      {"{\"1\": \"incus\",\n\"2\" \"stapes\"}", "line 2 is not valid JSON"},
      {"{\"1\": \"incus\", \"2\": 1e999}", "a number that is beyond all that is read"},
      {"{\"1\": \"incus\",\n\"x\": \"stapes\"}", "line 2 is no entry of a table"}};
  for (const auto& [text, word] : wrong)
    expectRefused(refused(text), Reason::Unreadable, word);
  expectRefused(refused("{\"EchoTime\": 0.02, \"SeriesNumber\": 5}"), Reason::Unreadable,
                "no names of label values");
  expectRefused(refused("{\"1\": "), Reason::Unreadable, "no names of label values");
  const auto twice = refusalOf(
      [&] { readLabelTable(putFile(folder / "a.json", "{\"incus\": 1, \"stapes\": 1}")); });
  expectRefused(twice, Reason::Unreadable, "a.json: its line 1 gives index 1 a second name");
  expectRefused(refused(std::string("\xff\xfe"
                                    "1\0,\0",
                                    6)),
                Reason::Unreadable, "UTF-16");
  expectRefused(refused("organ,volume\nincus,3\n"), Reason::Unreadable, "no names of label values");
  expectRefused(refused(""), Reason::Unreadable);
  expectRefused(refusalOf([&] { readLabelTable(folder / "none.csv"); }), Reason::NotFound);
}

namespace
{

/// A label map of 3 x 2 x 2 voxels with the values 4, 7 and 3.
std::filesystem::path putLabels(const std::filesystem::path& path,
                                const std::vector<std::uint8_t>& values = {0, 4, 4, 0, 0, 7, 0, 0,
                                                                           0, 0, 0, 3})
{
  return putFile(path, "NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\n"
                       "sizes: 3 2 2\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
                       "kinds: domain domain domain\nencoding: raw\nspace origin: (0,0,0)\n\n" +
                           bytesOf(values));
}

std::string namesOf(const LoadedLabels& loaded)
{
  std::string text;
  for (const auto& map : loaded.maps)
    for (const auto& segment : map.segments)
      text += std::to_string(segment.index) + ":" + segment.name + ";";
  for (const auto& unread : loaded.unread)
    text += std::to_string(unread.index) + ":" + unread.name + (unread.isEmpty ? "-" : "!") + ";";
  return text;
}

} // namespace

TEST(LabelTable, TakesTheColumnThatIsMeantWhereRowsAreNumbered)
{
  const TestFolder folder;
  for (const char* text : {"nr,label value,name\n1,4,incus\n2,9,stapes\n", // by its title
                           "id,label,name\n4,4,incus\n9,9,stapes\n",       // the same
                           "id,label,name\n4,bone,incus\n9,8,stapes\n",    // no index
                           "id,label\n4,incus\n9,stapes\n"})
  {
    const LabelTable table = readLabelTable(putFile(folder / "names.csv", text));
    ASSERT_EQ(table.segments.size(), 2U) << text;
    EXPECT_EQ(table.segments[0].index, 4) << text;
    EXPECT_EQ(table.segments[1].index, 9) << text;
    EXPECT_EQ(table.segments[1].name, "stapes") << text;
  }
}

TEST(LabelTable, NamesALabelFileAndTellsWhatItDoesNot)
{
  const TestFolder folder;
  const auto labels = putLabels(folder / "a.nrrd");
  LabelNaming naming;
  naming.table = putFile(folder / "names.csv", "index,name\n4,incus\n7,stapes\n9,malleus\n");
  const LoadedLabels loaded = loadLabels(labels, {}, naming);
  EXPECT_EQ(namesOf(loaded), "3:label 3;4:incus;7:stapes;9:malleus-;");
  const auto tells = [&loaded](const std::string& note)
  { return std::count(loaded.notes.begin(), loaded.notes.end(), note) == 1; };
  EXPECT_TRUE(tells("label 3 has no name in the table of names"));
  EXPECT_EQ(loaded.maps[0].segments[1].voxels, 2U);

  naming.table = putFile(folder / "bad.csv", "index,name\n4,incus\n4,stapes\n");
  expectRefused(refusalOf([&] { loadLabels(labels, {}, naming); }), Reason::Unreadable,
                "bad.csv: its line 3");
}

TEST(LabelTable, StructuresOfOneNameAreNumbered)
{
  const TestFolder folder;
  const auto labels = putLabels(folder / "a.nrrd");
  LabelNaming naming;
  naming.table = putFile(folder / "names.csv", "index,name\n3,nerve\n4,nerve\n7,incus\n");
  const LoadedLabels loaded = loadLabels(labels, {}, naming);
  EXPECT_EQ(namesOf(loaded), "3:nerve;4:nerve 2;7:incus;");
  EXPECT_EQ(std::count_if(loaded.notes.begin(), loaded.notes.end(),
                          [](const std::string& note)
                          { return note.find("'nerve 2'") != note.npos; }),
            1);
}

TEST(LabelTable, NamesASingleStructureOnlyIfAsked)
{
  const TestFolder folder;
  const auto mask = putLabels(folder / "mask.nrrd", {0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  LabelNaming naming;
  naming.table = putFile(folder / "names.csv", "index,name\n1,incus\n");
  EXPECT_EQ(namesOf(loadLabels(mask, {}, naming)), "1:incus;");
  naming.namesSingle = false;
  EXPECT_EQ(namesOf(loadLabels(mask, {}, naming)), "1:mask;");
}

TEST(LabelTable, IsFoundBesideTheFileUnderItsName)
{
  const TestFolder folder;
  for (const char* end : {".csv", ".tsv", ".json", ".txt", ".ctbl", ".label"})
  {
    const auto labels = putLabels(folder / "scan.nrrd");
    const bool isJson = std::string(end) == ".json";
    putFile(folder / ("scan" + std::string(end)),
            isJson ? "{\"4\": \"incus\", \"9\": \"malleus\"}"
                   : "4 incus 1 2 3 255\n9 malleus 1 2 3 255\n9 again 1 2 3 255\n");
    const LoadedLabels loaded = loadLabels(labels);
    EXPECT_EQ(namesOf(loaded), "3:label 3;4:incus;7:label 7;9:malleus-;") << end;
    const auto ofTable = std::count_if(loaded.notes.begin(), loaded.notes.end(),
                                       [](const std::string& note)
                                       { return note.find("table of names") != note.npos; });
    EXPECT_EQ(ofTable, isJson ? 1 : 2) << end << ": what was left out is told of";
    std::filesystem::remove(folder / ("scan" + std::string(end)));
  }
  // What converters write beside an image is no table.
  putFile(folder / "scan.json", "{\"EchoTime\": 0.02, \"SeriesNumber\": 4}");
  EXPECT_EQ(namesOf(loadLabels(folder / "scan.nrrd")), "3:label 3;4:label 4;7:label 7;");
}

TEST(UniqueNames, NumbersNoStructureByANameThatAnotherStates)
{
  UniqueNames names;
  for (const char* stated : {"nerve", "nerve", "nerve 2", "nerve 4"})
    names.reserve(stated);
  std::vector<std::string> notes;
  EXPECT_EQ(names.take("nerve", notes), "nerve");
  EXPECT_EQ(names.take("nerve", notes), "nerve 3");
  EXPECT_EQ(names.take("nerve 2", notes), "nerve 2");
  EXPECT_EQ(names.take("nerve 4", notes), "nerve 4");
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("'nerve 3'"), std::string::npos);
}

} // namespace petrous::imaging
