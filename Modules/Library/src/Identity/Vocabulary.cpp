#include "Vocabulary.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "petrous/Core/AsciiCase.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Library/Deidentification.h"

namespace petrous::library
{

namespace
{

// Spaces around each word.
constexpr std::string_view kVocabulary =
    " 2D 3D AC ACOUSTIC ADC AIR ANGIO ANGLE ANTERIOR ARTERIAL AX AXIAL BILATERAL BONE BRAIN CANAL "
    "CBCT CE CERVICAL CISS CLEAR CM CONE CONTRAST COR CORONAL COW CP CPA CT CTA CTV CUBE DELAYED "
    "DIR DRIVE DTI "
    "DUAL DWI EAR ECHO ENERGY EPI FA FACE FAST FAT FFE FIESTA FILTERED FISP FLAIR FLASH FOV FS FSE "
    "GD "
    "GRADIENT GRE HEAD HELICAL HIGH HIRES HR HU IAC IAM IMAGE INFERIOR INNER INTERNAL INVERSION IR "
    "JUGULAR KERNEL KV LATERAL LEFT LOCALIZER LOCALISER LOW LUNG MA MAP MASK MASTOID MAX MEDIUM "
    "MIDDLE MIN MIP MM MPR MPRAGE MR MRA MRI MRV MULTI NASAL NATIVE NECK NERVE NON OBL OBLIQUE "
    "ORBIT "
    "OSSICLES PD PELVIS PERFUSION PET PETROUS PHASE PLAIN POST POSTERIOR PRE PROTON RECON REFORMAT "
    "RESOLUTION "
    "RESTRICTED RIGHT SAG SAGITTAL SCAN SCOUT SE SERIES SHARP SIGMOID SINUS SKULL SLICE SLICES "
    "SMOOTH "
    "SOFT SPACE SPGR SPIN SPINE SPIRAL SSFP STANDARD STD STEALTH STIR STUDY SUPERIOR SURVEY SWI T1 "
    "T1W T2 T2W "
    "TE TEMPORAL TEST THICK THIN THORAX TIR TISSUE TOF TR TRANSVERSE TRA TSE TUMOR TUMOUR TYMPANIC "
    "UHR ULTRA "
    "VENOUS VIBE VOLUME VRT WATER WINDOW WITH WITHOUT WO "
    "ARTERY AUDITORY BASILAR BULB CAROTID CELLS CEREBELLUM CHOLESTEATOMA CHORDA COCHLEA COCHLEAR "
    "DURA EXTERNAL FACIAL INCUS LABYRINTH MALLEUS MENINGIOMA OSSICLE PLATE SCHWANNOMA SEMICIRCULAR "
    "STAPES STEM TEGMEN TYMPANI UTRICLE VEIN VERTEBRAL VESTIBULAR VESTIBULE "
    "ABDUCENS ACCESSORY ADITUS AMPULLA ANTRUM AORTA APERTURE APEX AQUEDUCT ARACHNOID "
    "ARCH ARCUATE ARTERIA ATTIC AURICLE BASAL BLOOD BOGENGANG BONES BRAINSTEM BULBUS "
    "CANALIS CAPSULE CAROTIS CARTILAGE CAVERNOUS CAVITY CEREBELLAR CEREBRAL "
    "CEREBROSPINAL CISTERN CLIVUS COCHLEARIFORM COCHLEE COMMON CONDYLE CONFLUENS "
    "CRANIAL CRUS CSF DEHISCENCE DUCT EAC EARDRUM EMINENCE EMISSARY ENDOLYMPH "
    "ENDOLYMPHATIC ENDOLYMPHATICUS EPITYMPANUM EUSTACHIAN EYE FACIALIS FENESTRA "
    "FLOCCULUS FLUID FORAMEN FOSSA FRONTAL GANGLION GEHOERGANG GENICULATE GENU "
    "GESICHTSNERV GLAND GLOMUS GLOSSOPHARYNGEAL GRANULATION GRANULOMA GREATER HOERNERV "
    "HYOID HYPOGLOSSAL HYPOTYMPANUM IAA ICA IJV IMPLANT INCUDOMALLEOLAR INCUDOSTAPEDIAL "
    "INTERNA JOINT JUGULARIS LABYRINTHINE LACERUM LENS LESION LIMACON MAGNUM MANDIBLE "
    "MASTOIDS MATER MAXILLA MAXILLARY MEATUS MEDULLA MEMBRANA MEMBRANE MESOTYMPANUM "
    "MODIOLUS MUSCLE NERF NERVES NERVUS NEUROMA OCCIPITAL OPTIC OSSELETS OVAL OVALE "
    "PARAGANGLIOMA PARIETAL PAROTID PERILYMPH PETROSAL PINNA PNEUMATIZED PORUS "
    "PROCESS PROMONTORY PYRAMIDAL RECESS ROTUNDA ROUND SAC SACCULE SACCUS SCALA SCUTUM "
    "SEGMENT SELLA SEMICIRCULARIS SEPTUM SKIN SPHENOID SPINOSUM SPUR STAPEDIUS STYLOID "
    "STYLOMASTOID SUBARCUATE SUPERFICIAL TENDON TENSOR TMJ TRACT TRIGEMINAL TROMMELFELL "
    "TUBE TURN TYMPAN TYMPANICA VAGUS VENA VENTRICLE VERTEBRA VESSEL VESTIBULI "
    "VESTIBULOCOCHLEAR VESTIBULUM ZYGOMA ZYGOMATIC "
    "FELSENBEIN INNENOHR KNOCHEN KOPF LINKS MIT MITTELOHR NATIV OHNE OHR RECHTS SCHAEDEL "
    "SCHLAEFENBEIN "
    "AVEC CRANE DROIT GAUCHE OREILLE OS ROCHER ROCHERS SANS TETE "
    // without which a text would mean something else
    "EXCEPT KEIN KEINE NICHT NO NONE NOT PAS RECURRENT REMOVED RESECTED RESIDUAL UNRESECTED ";

constexpr std::string_view kManufacturers =
    "|AGFA|ANALOGIC|BRUKER|CANON|CANON_MCA|CARESTREAM|CARESTREAM HEALTH|ELSCINT|FUJIFILM|"
    "FUJIFILM CORPORATION|FUJIFILM HEALTHCARE CORPORATION|FONAR|GE|GE HEALTHCARE|GE MEDICAL "
    "SYSTEMS|"
    "HITACHI|HITACHI MEDICAL CORPORATION|HITACHI, LTD.|IMAGING SCIENCES "
    "INTERNATIONAL|J.MORITA.MFG.CORP.|KAVO|MARCONI MEDICAL SYSTEMS|"
    "MEDTRONIC|MINFOUND|NEUROLOGICA|NEUSOFT|NEUSOFT MEDICAL SYSTEMS|PHILIPS|PHILIPS HEALTHCARE|"
    "PHILIPS MEDICAL SYSTEMS|PICKER INTERNATIONAL, INC.|PLANMECA|PLANMED|PETROUS|SAMSUNG|"
    "SAMSUNG ELECTRONICS|SHIMADZU|SIEMENS|SIEMENS HEALTHCARE|SIEMENS HEALTHINEERS|SIRONA|SOREDEX|"
    "TOSHIBA|TOSHIBA_MEC|UIH|UNITED IMAGING|XORAN|CUREFAB|QR "
    "S.R.L.|NEWTOM|OFFIS|QIICR|NIH|MEVISLAB|BRAINLAB|VARIAN MEDICAL SYSTEMS|ELEKTA|RAYSEARCH "
    "LABORATORIES|";

std::string upper(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), core::asciiUpper);
  return text;
}

std::string trimmed(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

bool isPartOfWord(unsigned char c)
{
  return std::isalnum(c) != 0 || c >= 0x80; // letters of other character sets
}

// Calls `use(word)` for each word of letters and digits.
void forEachWord(const std::string& text, const std::function<void(const std::string&)>& use)
{
  std::string word;
  for (const char c : text + " ")
    if (isPartOfWord(static_cast<unsigned char>(c)))
      word += c;
    else if (!word.empty())
    {
      use(word);
      word.clear();
    }
}

bool isShortNumber(const std::string& word)
{
  return word.size() <= 3 && std::all_of(word.begin(), word.end(),
                                         [](unsigned char c) { return std::isdigit(c) != 0; });
}

} // namespace

bool isInVocabulary(const std::string& word)
{
  return kVocabulary.find(" " + word + " ") != std::string_view::npos;
}

bool isDescriptorWord(const std::string& word)
{
  return isInVocabulary(upper(word));
}

bool isKnownManufacturer(const std::string& text)
{
  std::string name = upper(text);
  while (!name.empty() && name.back() == ' ')
    name.pop_back();
  return !name.empty() && name.find('|') == std::string::npos &&
         kManufacturers.find("|" + name + "|") != std::string_view::npos;
}

std::string reducedToVocabulary(const std::string& text, const IdentityWords& people)
{
  // With escape sequences (ISO 2022), what looks like letters may be parts of other characters.
  if (text.find('\x1b') != std::string::npos)
    return {};
  // Numbers beside each other are parts of a date or an identifier ("14.03.62", "943 476 919"), but
  // for a decimal of millimetres ("0.6 mm").
  std::vector<std::string> numbers;
  std::string kept;
  bool hasWord = false;
  const auto keep = [&kept](const std::string& word) { kept += (kept.empty() ? "" : " ") + word; };
  const auto keepNumbers = [&](const std::string& next)
  {
    const bool isOne = numbers.size() == 1 || (numbers.size() == 2 && upper(next) == "MM");
    for (const std::string& number : numbers)
      if (isOne && isShortNumber(number) && !people.hasWord(number))
        keep(number);
    numbers.clear();
  };
  forEachWord(text,
              [&](const std::string& word)
              {
                const bool known = isInVocabulary(upper(word));
                if (!known && std::isdigit(static_cast<unsigned char>(word.front())) != 0)
                  return numbers.push_back(word);
                keepNumbers(word);
                if (!known || people.hasWord(word))
                  return;
                hasWord = true;
                keep(word);
              });
  keepNumbers({});
  return hasWord ? kept : std::string();
}

void IdentityWords::add(const std::string& text)
{
  forEachWord(text,
              [this](const std::string& word)
              {
                const std::string known = upper(word);
                if (known.size() >= 3 && !isInVocabulary(known))
                  m_words.insert(known);
              });
}

void IdentityWords::addName(const std::string& text)
{
  forEachWord(text,
              [this](const std::string& word)
              {
                if (word.size() >= 2)
                  m_words.insert(upper(word));
              });
}

void IdentityWords::addIdentifier(const std::string& text)
{
  add(text);
  constexpr std::size_t kTelling = 5; // characters
  const std::string whole = trimmed(text);
  if (whole.size() >= kTelling)
    m_identifiers.insert(upper(whole));
  // Runs of digits, and what those give together that only separators divide: "943-476-919" is
  // 943476919, and of "4711471-3" and "2024/4711471" the number may be 4711471 alone.
  constexpr const char* kDigits = "0123456789";
  constexpr std::size_t kMostDigits = 20;
  std::vector<std::string> open; // that end where the next run begins
  for (std::size_t from = whole.find_first_of(kDigits), before = from; from != std::string::npos;)
  {
    const std::size_t to = std::min(whole.find_first_not_of(kDigits, from), whole.size());
    if (std::any_of(whole.begin() + static_cast<std::ptrdiff_t>(before),
                    whole.begin() + static_cast<std::ptrdiff_t>(from),
                    [](unsigned char c) { return isPartOfWord(c); }))
      open.clear();
    open.emplace_back();
    for (std::string& digits : open)
    {
      digits.append(whole, from, to - from);
      if (const auto number = core::parseDouble(digits); number && *number >= kMinNumber)
        m_numbers.insert(*number);
    }
    open.erase(std::remove_if(open.begin(), open.end(),
                              [](const std::string& digits)
                              { return digits.size() >= kMostDigits; }),
               open.end());
    before = to;
    from = whole.find_first_of(kDigits, to);
  }
}

bool IdentityWords::hasWord(const std::string& text) const
{
  bool found = false;
  forEachWord(text,
              [&](const std::string& word) { found = found || m_words.count(upper(word)) > 0; });
  return found;
}

bool IdentityWords::isIdentifier(const std::string& text) const
{
  const std::string whole = trimmed(text);
  const auto number = m_numbers.empty() ? std::nullopt : core::parseDouble(whole);
  return m_identifiers.count(upper(whole)) > 0 || (number && isIdentifier(*number));
}

bool IdentityWords::isIdentifier(double number) const
{
  return std::isfinite(number) && m_numbers.count(std::abs(number)) > 0;
}

bool IdentityWords::foundIn(const std::string& text) const
{
  if (text.find('^') != std::string::npos || text.find('@') != std::string::npos)
    return true;
  std::size_t digits = 0;
  for (const char c : text)
  {
    digits = std::isdigit(static_cast<unsigned char>(c)) != 0 ? digits + 1 : 0;
    if (digits >= 6)
      return true;
  }
  return hasWord(text);
}

} // namespace petrous::library
