#include "petrous/Presenters/FolderIdentity.h"

#include <gtest/gtest.h>

#include "../../../Modules/Imaging/Testing/TestDicom.h"
#include "BoneCase.h"
#include "petrous/Imaging/SeriesGeometry.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Library/PseudonymMap.h"
#include "petrous/Presenters/CaseExport.h"
#include "petrous/Presenters/CaseTransfer.h"
#include "petrous/Presenters/IdentityText.h"

namespace petrous::presenters
{
namespace
{

namespace fs = std::filesystem;

bool mentions(const std::vector<std::string>& lines, const std::string& what)
{
  return std::any_of(lines.begin(), lines.end(),
                     [&](const auto& line) { return line.find(what) != std::string::npos; });
}

TEST(FolderIdentity, TheMapIsNeverWrittenIntoTheInput)
{
  const imaging::test::TemporaryFolder folder;
  const fs::path in = folder.path() / "in";
  fs::create_directories(in / "deeper");
  DeidentifyRequest request;
  request.input = in;
  request.output = folder.path() / "out";
  request.map = in / "deeper" / "map";
  EXPECT_THROW(deidentifyFolder(request, "a long passphrase"), core::Error);
  EXPECT_FALSE(fs::exists(request.map));
  EXPECT_NO_THROW(refuseWithin(folder.path() / "in-report.txt", in, "report"));
}

TEST(FolderIdentity, ASecretIsOverwritten)
{
  std::string secret(40, 's');
  const char* bytes = secret.data(); // the string keeps its memory
  wipe(secret);
  EXPECT_TRUE(secret.empty());
  EXPECT_EQ(std::count(bytes, bytes + 40, 's'), 0);
}

scene::Case describedCase()
{
  scene::Case value;
  value.name = "left ear";
  value.ct.geometry = core::GridGeometry({512, 512, 300}, Eigen::Vector3d(0.45, 0.45, 0.5),
                                         Eigen::Vector3d::Zero());
  scene::LabelPart part;
  scene::StructurePart nerve;
  nerve.name = "facial nerve";
  part.structures.push_back(nerve);
  value.labels.push_back(part);
  value.description.note = "as discussed";
  value.description.tags = {"teaching"};
  value.description.date = "2026-03-31";
  return value;
}

TEST(IdentityOfACase, WhatTheUserTypedLeavesWithTheSceneOnly)
{
  const scene::Case value = describedCase();
  SendParts parts;
  parts.ct = true;
  IdentityReport report = identityReport(value, parts);
  EXPECT_TRUE(mentions(report.leaves, "512 x 512 x 300"));
  EXPECT_FALSE(mentions(report.leaves, "left ear"));
  EXPECT_FALSE(mentions(report.leaves, "facial nerve"));
  EXPECT_TRUE(mentions(report.warnings, "face")) << "230 x 230 x 150 mm";

  parts.scene = true;
  report = identityReport(value, parts);
  for (const char* typed : {"left ear", "facial nerve", "teaching", "the note"})
    EXPECT_TRUE(mentions(report.leaves, typed)) << typed;
  EXPECT_TRUE(mentions(report.warnings, "the note"));
  EXPECT_TRUE(mentions(report.stays, "planned date"));
  EXPECT_FALSE(mentions(report.leaves, "as discussed")) << "the words themselves are not repeated";

  parts.note = false;
  report = identityReport(value, parts);
  EXPECT_TRUE(mentions(report.stays, "the note"));
  EXPECT_FALSE(mentions(report.warnings, "the note"));
}

TEST(IdentityOfACase, TimesAndSignersStayUnlessTheyAreAskedFor)
{
  scene::Case value = describedCase();
  dissection::StrokeInfo info;
  info.startedAt = "2026-03-30T08:15:00Z";
  value.dissection = dissection::Dissection(
      {std::make_shared<const dissection::Stroke>(info, dissection::Stroke::Voxels{1})},
      dissection::History::line(1, 1));
  scene::ImagePart mr;
  mr.name = "T2";
  mr.registered = true;
  mr.registration.emplace();
  mr.registration->signOff = scene::SignOff{"A. Surgeon", "2026-03-30T09:00:00Z", {}};
  value.mr.push_back(mr);
  value.attachments.emplace_back();
  value.attachments.back().name = "a.png";
  value.attachments.back().kind = scene::Attachment::Kind::Screenshot;
  value.attachments.back().date = "2026-03-30";

  const char* const texts[] = {"planned date", "time of each stroke", "signed the registration",
                               "dates of attachments"};
  library::ArchiveOptions options;
  SendParts parts;
  parts.scene = true;
  for (const IdentityReport& report :
       {identityReport(value, options), identityReport(value, parts)})
    for (const char* text : texts)
    {
      EXPECT_TRUE(mentions(report.stays, text)) << text;
      EXPECT_FALSE(mentions(report.leaves, text)) << text;
    }
  options.keepIdentity = true;
  const IdentityReport report = identityReport(value, options);
  for (const char* text : texts)
  {
    EXPECT_TRUE(mentions(report.leaves, text)) << text;
    EXPECT_FALSE(mentions(report.stays, text)) << text;
  }
  EXPECT_TRUE(mentions(report.warnings, "signed the registration"));
  EXPECT_EQ(report.text().find("A. Surgeon"), std::string::npos);
}

TEST(IdentityOfACase, EveryNameThatLeavesIsLookedAt)
{
  scene::Case value = describedCase();
  dissection::StrokeInfo info;
  info.structures = {{"facial nerve", 1.0}, {"tumour of 4711471", 1.0}};
  value.dissection = dissection::Dissection(
      {std::make_shared<const dissection::Stroke>(info, dissection::Stroke::Voxels{1})},
      dissection::History::line(1, 1));
  value.mr.emplace_back();
  value.mr.back().name = "T2 of 14.03.1962";
  value.labels.front().structures.front().codes.algorithmName = "by Doe^John";
  value.attachments.resize(2);
  value.attachments[0].kind = value.attachments[1].kind = scene::Attachment::Kind::Recording;
  value.attachments[0].name = "a.ticks";
  value.attachments[0].note = "of Doe^John";
  value.attachments[1].name = "19310517.ticks";
  SendParts parts;
  parts.scene = true;
  const auto warnings = identityReport(value, parts).warnings;
  EXPECT_TRUE(mentions(warnings, "names of structures that are gone, in strokes that touched "
                                 "them: 1 of 1"));
  EXPECT_TRUE(mentions(warnings, "names of MRs, approaches and saved views: 1 of 2"));
  EXPECT_TRUE(mentions(warnings, "segmentation files gave structures: 1 of 1"));
  EXPECT_TRUE(mentions(warnings, "names and notes of attachments: 2 of 3"));
  parts.note = false;
  EXPECT_TRUE(mentions(identityReport(value, parts).warnings, "attachments: 1 of 2"));
}

// Beside the warnings, which a batch keeps in its report.
TEST(IdentityOfACase, SaysWhichNamesAreCounted)
{
  scene::Case value = describedCase();
  value.description.tags = {"teaching", "mrn 4711471", "nr. 4711472"};
  SendParts parts;
  parts.scene = true;
  const IdentityReport report = identityReport(value, parts);
  EXPECT_TRUE(mentions(report.warnings, "tags: 2 of 3"));
  EXPECT_FALSE(mentions(report.warnings, "4711471"));
  ASSERT_EQ(report.counted.size(), 1U);
  EXPECT_EQ(report.counted[0], "tags, which may be a patient's: 'mrn 4711471', 'nr. 4711472'");
  EXPECT_NE(report.text().find(report.counted[0]), std::string::npos);
}

TEST(IdentityOfACase, OrdinaryNamesAndNumbersAreFound)
{
  const scene::Case value = describedCase();
  const IdentityText identity(value);
  for (const char* text :
       {"John Doe",       "Doe John, ward 3",    "Mrs Smith A12-345", "DOE_JOHN",
        "Doe^John",       "seen by Dr. Roe",     "M\u00fcller Anna",  "record A12345",
        "MRN 12-34567",   "943 476 919",         "born 14.03.62",     "a@b.example",
        "1931-05-17",     "geb. 12. April 1961", "12 Apr 1961",       "12-APR-61",
        "April 12, 1961", "3. M\u00e4rz 1958",   "3. Maerz 1958",     "1.Mai1970",
        "May 1st, 1970",  "24. Dez. 2001",       "Anna Plus"})
    EXPECT_TRUE(identity.mayIdentify(text)) << text;
  for (const char* text : {"",
                           "left ear",
                           "Facial Nerve",
                           "facial_nerve_left",
                           "T2 CISS",
                           "DWI b1000",
                           "teaching",
                           "Vestibular Schwannoma, left",
                           "Translabyrinthine Approach",
                           "L5-S1",
                           "0.6 mm",
                           "main",
                           "MR 3T",
                           "Segment 1",
                           "Incus 2",
                           "cholesteatoma revision",
                           "Sigmoid Sinus R",
                           "3 margins 10 mm",
                           "20 decibel 40",
                           "implant of April",
                           "Tumour Not Resected",
                           "cochlea post op",
                           "2 junctions 30"})
    EXPECT_FALSE(identity.mayIdentify(text)) << text;
}

// By the salted hash that the case keeps; whoever has the case alone cannot compare.
TEST(IdentityOfACase, ThePatientsOwnNameAndNumberAreFoundByTheirHashes)
{
  const auto salted = [](const std::string& hash) { return "salted " + hash; };
  scene::Case value = describedCase();
  const auto hashOf = [&](const std::string& id, const std::string& name)
  {
    const imaging::PatientKey key = imaging::patientKey(id, {}, name, {});
    const auto hash = [&](std::size_t number)
    {
      const std::string text = std::to_string(number);
      return salted(
          library::sha256Of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
    };
    scene::PatientHash patient;
    patient.id = hash(key.id);
    patient.name = hash(key.name);
    return patient;
  };
  value.ct.isFrameSalted = true;
  value.ct.patient = hashOf("q7-b", "sharp^plain");
  const IdentityText identity(value, salted);
  for (const char* text :
       {"the ear of plain sharp, left", "sharp plain", "SHARP, Plain", "of q7-b", "Q7-B"})
    EXPECT_TRUE(identity.mayIdentify(text)) << text;
  for (const char* text : {"plain", "sharp", "q7", "sharp ear plain"})
    EXPECT_FALSE(identity.mayIdentify(text)) << text;
  EXPECT_TRUE(identity.mayIdentifySentence("'plain sharp' lies outside the CT"));
  EXPECT_FALSE(IdentityText(value).mayIdentify("plain sharp")) << "without the salt";
}

// Words that match no hash of a lost salt are not known to be none of the patient's.
TEST(IdentityOfACase, NothingIsKnownOfThePatientWhereTheSaltWasLost)
{
  scene::Case value = describedCase();
  const std::string hash(64, 'a');
  value.ct.patient = {hash, "", hash, "", {hash}};
  const auto saltOf = [](const std::string& id)
  {
    return scene::IdentitySalt([id](const std::string& text) { return id + text; },
                               [id] { return id; });
  };
  EXPECT_TRUE(IdentityText(value, saltOf("one")).knowsName()) << "not salted yet";
  scene::saltIdentity(value.ct, saltOf("one"));
  EXPECT_TRUE(IdentityText(value, saltOf("one")).knowsName());
  EXPECT_FALSE(IdentityText(value, saltOf("one")).mayIdentify("Kowalski"));
  const IdentityText lost(value, saltOf("two"));
  EXPECT_FALSE(lost.knowsName());
  EXPECT_TRUE(lost.mayIdentify("Kowalski"));
  EXPECT_FALSE(lost.mayIdentify("facial nerve, left"));
  EXPECT_FALSE(IdentityText(value).knowsName());
  value.ct.saltId.clear(); // as an earlier version saved it
  EXPECT_TRUE(IdentityText(value, saltOf("")).knowsName());
  EXPECT_FALSE(IdentityText(value, saltOf("two")).knowsName());
}

// As import keeps them: a surname alone is found, in any case, and with a number behind it.
TEST(IdentityOfACase, ThePatientsSurnameAloneIsFound)
{
  const auto salted = [](const std::string& hash) { return "salted " + hash; };
  const auto saltedKey = [&](std::size_t key)
  {
    const std::string text = std::to_string(key);
    return salted(
        library::sha256Of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  };
  scene::Case value = describedCase();
  value.ct.isFrameSalted = true;
  for (const std::size_t part : imaging::patientKey({}, {}, "M\u00fcller^Jane", {}).nameParts)
    if (part != 0)
      value.ct.patient.nameParts.push_back(saltedKey(part));
  ASSERT_EQ(value.ct.patient.nameParts.size(), 2U);
  const IdentityText identity(value, salted);
  for (const char* text :
       {"M\u00fcller links", "mueller1", "ear of jane", "station MUELLER", "janes cyst",
        "m\u00fcllers cyst", "M\u00fcllertumor", "facialm\u00fcller", "M\u00fcllerCochlea"})
  {
    EXPECT_TRUE(identity.mayIdentify(text)) << text;
    EXPECT_FALSE(IdentityText(value).mayIdentify(text)) << "without the salt";
  }
  for (const char* text : {"left ear", "m\u00fchle", "janet"})
    EXPECT_FALSE(identity.mayIdentify(text)) << text;
  EXPECT_TRUE(identity.isOfField("facial nerve, left"));
  EXPECT_FALSE(identity.isOfField("facial nerve of smith"));
}

TEST(IdentityOfACase, NotesAreLookedAtAndThoseOfGoneNamesStay)
{
  scene::Case value = describedCase();
  value.labels.front().notes = {"'facial nerve' is thin", "'DOE^JOHN' left out"};
  SendParts parts;
  parts.scene = true;
  IdentityReport report = identityReport(value, parts);
  EXPECT_TRUE(mentions(report.leaves, "noted on import and registration: 1 sentence"));
  EXPECT_TRUE(mentions(report.stays, "noted of parts that the case does not have"));
  EXPECT_FALSE(mentions(report.warnings, "noted on import"));
  value.ct.notes = {"of Doe^John"};
  report = identityReport(value, parts);
  EXPECT_TRUE(mentions(report.warnings, "noted on import"));
  EXPECT_FALSE(mentions(report.leaves, "sealed"));
  value.ct.patient.id = "a hash";
  EXPECT_TRUE(mentions(identityReport(value, parts).leaves, "sealed"));
}

TEST(IdentityOfACase, TextInThePixelsIsWarnedOfWhereverTheyLeave)
{
  std::vector<imaging::SliceHeader> stack(3);
  for (std::size_t k = 0; k < stack.size(); ++k)
  {
    stack[k].file = std::to_string(k);
    stack[k].position = Eigen::Vector3d(0.0, 0.0, static_cast<double>(k));
    stack[k].rowDirection = Eigen::Vector3d::UnitX();
    stack[k].columnDirection = Eigen::Vector3d::UnitY();
    stack[k].pixelSpacing = Eigen::Vector2d::Ones();
    stack[k].rows = stack[k].columns = 4;
    stack[k].burnedIn = imaging::BurnedInText::Stated;
  }
  const volume::PixelFaults pixels = imaging::pixelFaults(stack);
  scene::Case value = describedCase();
  value.mr.emplace_back();
  value.mr.back().name = "T2";
  SendParts parts;
  parts.ct = parts.mr = parts.scene = true;
  EXPECT_FALSE(mentions(identityReport(value, parts).warnings, "text in them"));
  value.mr.back().provenance.pixels = pixels;
  EXPECT_TRUE(mentions(identityReport(value, parts).warnings, "the pixels of MR 'T2' may have"));
  value.ct.provenance.pixels = pixels;
  EXPECT_TRUE(mentions(identityReport(value, parts).warnings, "the pixels of the CT, MR 'T2'"));
  library::ArchiveOptions options;
  EXPECT_TRUE(mentions(identityReport(value, options).warnings, "the CT, MR 'T2'"));
  options.planOnly = true;
  EXPECT_FALSE(mentions(identityReport(value, options).warnings, "text in them"));
  ExportOptions written;
  for (const auto& [what, text] :
       {std::pair("ct", "the CT may"), std::pair("dissected", "the CT may"),
        std::pair("mr", "MR 'T2' may")})
  {
    written.what = what;
    EXPECT_TRUE(mentions(identityWarnings(value, written), text)) << what;
  }
}

TEST(IdentityOfACase, ARegionOfTheEarShowsNoFace)
{
  scene::Case value = describedCase();
  value.ct.geometry =
      core::GridGeometry({400, 400, 300}, Eigen::Vector3d::Constant(0.2), Eigen::Vector3d::Zero());
  SendParts parts;
  parts.ct = true;
  EXPECT_FALSE(mentions(identityReport(value, parts).warnings, "face"));
}

TEST(IdentityOfACase, AWholeHeadIsWarnedOfUnlessItIsMaskedOrCutAway)
{
  const scene::Case value = describedCase();
  const library::ArchiveOptions options;
  EXPECT_TRUE(mentions(identityReport(value, options).warnings, "whole head"));
  scene::ImageMask mask;
  mask.face = true;
  EXPECT_FALSE(mentions(identityReport(value, options, mask).warnings, "head"));
  EXPECT_TRUE(mentions(identityReport(value, options, mask).stays, "the face"));
  mask = {};
  const Eigen::Vector3d middle = value.ct.geometry.patientBounds().center();
  mask.region = core::PatientBox(middle - Eigen::Vector3d::Constant(30.0),
                                 middle + Eigen::Vector3d::Constant(30.0));
  EXPECT_FALSE(mentions(identityReport(value, options, mask).warnings, "head"));
  library::ArchiveOptions plan;
  plan.planOnly = true;
  EXPECT_FALSE(mentions(identityReport(value, plan).warnings, "head"));
}

// Nothing says of one image both that it can be masked and that it cannot.
TEST(IdentityOfACase, AFaceThatIsLeftIsToldOfWithWhatToDo)
{
  const scene::Case value = describedCase();
  const std::vector<scene::ImageWithFace> faces = {
      {"the CT", "", ""}, {"MR 'T2'", "T2", "MR 'T2': the chin is cut off; leave the image out"}};
  const library::ArchiveOptions options;
  const auto warnings = identityReport(value, options, {}, nullptr, &faces).warnings;
  EXPECT_TRUE(mentions(warnings, "the face was left in the CT: who sees it"));
  EXPECT_TRUE(mentions(warnings, "--mask-face"));
  EXPECT_TRUE(mentions(warnings, "--roi"));
  EXPECT_TRUE(mentions(warnings, "was left in MR 'T2': who sees it can recognise the patient, and "
                                 "it cannot be masked"));
  EXPECT_TRUE(mentions(warnings, "the chin is cut off"));
  EXPECT_FALSE(mentions(faceWarnings({faces[1]}), "--mask-face"));
  EXPECT_TRUE(faceWarnings({}).empty());

  scene::ImageMask mask;
  mask.face = true;
  const std::vector<scene::ImageWithFace> masked = {faces[0]};
  const IdentityReport report = identityReport(value, options, mask, nullptr, &masked);
  EXPECT_FALSE(mentions(report.warnings, "face"));
  EXPECT_TRUE(mentions(report.stays, "the face, which is masked in the CT"));
  library::ArchiveOptions plan;
  plan.planOnly = true;
  EXPECT_FALSE(mentions(identityReport(value, plan, {}, nullptr, &faces).warnings, "face"));
}

TEST(IdentityOfACase, AFileForOtherProgramsIsLookedAtToo)
{
  scene::Case value = describedCase();
  value.labels.front().structures.front().name = "nerve of 4711471";
  const auto warnings = [&value](const char* what, const char* part = "")
  {
    ExportOptions options;
    options.what = what;
    options.part = part;
    return identityWarnings(value, options);
  };
  for (const char* what : {"ct", "dissected", "surface"})
    EXPECT_TRUE(mentions(warnings(what), "whole head")) << what;
  for (const char* what : {"mr", "mask"})
    EXPECT_TRUE(warnings(what).empty()) << what;
  EXPECT_TRUE(mentions(warnings("labels"), "names of structures: 1 of 1"));
  EXPECT_TRUE(mentions(warnings("structure", "nerve of 4711471"), "1 of 1"));
  ExportOptions masked;
  masked.what = "ct";
  masked.mask.face = true;
  EXPECT_TRUE(identityWarnings(value, masked).empty());
}

} // namespace

// The image of a case without a CT is one of its MRs, and may be sent without the others.
TEST(IdentityOfACase, ListsAnMrThatIsThePrimaryImageWhereItLeaves)
{
  scene::Case value = describedCase();
  value.ct.modality = scene::Modality::Mr;
  value.mr.emplace_back();
  value.mr.back().name = "T2";
  const auto leaves = [&value](const SendParts& parts)
  {
    const IdentityReport report = identityReport(value, parts);
    EXPECT_EQ(mentions(report.leaves, "MR: "), isSent(value, parts, {}));
    EXPECT_EQ(mentions(report.leaves, "MR 'T2': "), isSent(value, parts, "T2"));
    return std::pair(isSent(value, parts, {}), isSent(value, parts, "T2"));
  };
  SendParts parts;
  parts.ct = true;
  EXPECT_EQ(leaves(parts), std::pair(false, false)) << "there is none";
  parts.primary = true;
  EXPECT_EQ(leaves(parts), std::pair(true, false));
  parts = {};
  parts.mr = true;
  EXPECT_EQ(leaves(parts), std::pair(true, true));
  value.ct.modality = scene::Modality::Ct;
  EXPECT_EQ(leaves(parts), std::pair(false, true));
}

} // namespace petrous::presenters
