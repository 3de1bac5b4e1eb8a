<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>Language</name>
    <message>
        <source>en</source>
        <extracomment>Code of the language of this file, ISO 639-1</extracomment>
        <translation>de</translation>
    </message>
</context>
<context>
    <name>MainWindow</name>
    <message>
        <source>Library</source>
        <translation>Bibliothek</translation>
    </message>
    <message>
        <source>Another library has other cases. The usual folder is %1.</source>
        <translation>Eine andere Bibliothek hat andere Fälle. Der übliche Ordner ist %1.</translation>
    </message>
    <message>
        <source>&amp;Try again</source>
        <translation>&amp;Erneut versuchen</translation>
    </message>
    <message>
        <source>&amp;Usual folder, this time</source>
        <translation>&amp;Üblicher Ordner, diesmal</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>B&amp;eenden</translation>
    </message>
</context>
<context>
    <name>QObject</name>
    <message>
        <source>Looking for a face in the images…</source>
        <translation>Suche nach einem Gesicht in den Bildern…</translation>
    </message>
    <message>
        <source>Whether a face can be recognised is not known, as an image of the case could not be read.</source>
        <translation>Ob ein Gesicht erkennbar ist, ist nicht bekannt, da ein Bild des Falls nicht gelesen werden konnte.</translation>
    </message>
    <message>
        <source>A face can be recognised in %1.</source>
        <translation>Hier ist ein Gesicht erkennbar: %1.</translation>
    </message>
    <message>
        <source>An unexpected fault.</source>
        <translation>Ein unerwarteter Fehler.</translation>
    </message>
    <message>
        <source>There is not enough memory; close other programs.</source>
        <translation>Der Arbeitsspeicher reicht nicht; schließen Sie andere Programme.</translation>
    </message>
    <message>
        <source>An unexpected fault; the library is as it was before.</source>
        <translation>Ein unerwarteter Fehler; die Bibliothek ist wie zuvor.</translation>
    </message>
    <message>
        <source> or </source>
        <translation> oder </translation>
    </message>
    <message>
        <source>Views</source>
        <translation>Ansichten</translation>
    </message>
    <message>
        <source>The menu is not available</source>
        <translation>Das Menü ist nicht verfügbar</translation>
    </message>
    <message>
        <source>Open a case first</source>
        <translation>Öffnen Sie zuerst einen Fall</translation>
    </message>
    <message>
        <source>The manual is not installed here. The package petrous has it; in a build tree &apos;ninja manual&apos; makes it (needs python3-sphinx and python3-myst-parser)</source>
        <translation>Das Handbuch ist hier nicht installiert. Das Paket petrous enthält es; in einem Build-Verzeichnis erzeugt es „ninja manual“ (braucht python3-sphinx und python3-myst-parser)</translation>
    </message>
    <message>
        <source>No browser could be started. The manual is %1</source>
        <translation>Es ließ sich kein Browser starten. Das Handbuch ist %1</translation>
    </message>
    <message>
        <source>&amp;Save…</source>
        <translation>&amp;Speichern…</translation>
    </message>
    <message>
        <source>Text (*.txt)</source>
        <translation>Text (*.txt)</translation>
    </message>
    <message>
        <source>Saved as %1</source>
        <translation>Gespeichert als %1</translation>
    </message>
    <message>
        <source>%1 mm³</source>
        <translation>%1 mm³</translation>
    </message>
    <message>
        <source>drilling the first stroke</source>
        <translation>beim ersten Bohrzug</translation>
    </message>
    <message>
        <source>nothing drilled</source>
        <translation>nichts gebohrt</translation>
    </message>
    <message>
        <source>%1 %2, %3 mm³ removed</source>
        <translation>%1 %2, %3 mm³ abgetragen</translation>
    </message>
    <message>
        <source>stroke</source>
        <translation>Bohrzug</translation>
    </message>
    <message>
        <source>strokes</source>
        <translation>Bohrzüge</translation>
    </message>
    <message>
        <source>%1, drilling</source>
        <translation>%1, es wird gebohrt</translation>
    </message>
    <message>
        <source>Nothing was cut</source>
        <translation>Nichts wurde abgetragen</translation>
    </message>
    <message>
        <source>Removed %1 mm³</source>
        <translation>%1 mm³ abgetragen</translation>
    </message>
    <message>
        <source>  ·  %1 %2 mm³</source>
        <translation>  ·  %1 %2 mm³</translation>
    </message>
    <message>
        <source>&lt;h3&gt;Petrous %1&lt;/h3&gt;&lt;p&gt;Rehearsal of operations on the temporal bone and the skull base on the patient&apos;s own images.&lt;/p&gt;&lt;p&gt;For rehearsal and teaching; not a medical device, and no guide for an instrument in a patient.&lt;/p&gt;&lt;p&gt;Apache License 2.0. Made with VTK, ITK, GDCM and Qt.&lt;/p&gt;</source>
        <translation>&lt;h3&gt;Petrous %1&lt;/h3&gt;&lt;p&gt;Probe von Operationen am Felsenbein und an der Schädelbasis an den eigenen Bildern des Patienten.&lt;/p&gt;&lt;p&gt;Für Probe und Lehre; kein Medizinprodukt und keine Führung für ein Instrument im Patienten.&lt;/p&gt;&lt;p&gt;Apache License 2.0. Erstellt mit VTK, ITK, GDCM und Qt.&lt;/p&gt;</translation>
    </message>
    <message>
        <source>“%1” is there already. Replace it?</source>
        <translation>„%1“ gibt es schon. Ersetzen?</translation>
    </message>
    <message>
        <source>%1 are there already. Replace them?</source>
        <translation>%1 gibt es schon. Ersetzen?</translation>
    </message>
    <message>
        <source>&amp;Replace</source>
        <translation>&amp;Ersetzen</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>%1 min %2 s</source>
        <translation>%1 min %2 s</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>MR “%1”</source>
        <translation>MR „%1“</translation>
    </message>
    <message>
        <source>main</source>
        <translation>Hauptzugang</translation>
    </message>
    <message>
        <source>Finishing: %1</source>
        <translation>Wird beendet: %1</translation>
    </message>
    <message>
        <source>work in the background</source>
        <translation>Arbeit im Hintergrund</translation>
    </message>
    <message>
        <source>The view is cut away there; nothing is drawn under the pointer.</source>
        <translation>Dort ist die Ansicht weggeschnitten; unter dem Zeiger ist nichts zu sehen.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation</name>
    <message>
        <source>Structures</source>
        <translation>Strukturen</translation>
    </message>
    <message>
        <source>Appearance</source>
        <translation>Darstellung</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>Slices</source>
        <translation>Schichten</translation>
    </message>
    <message>
        <source>Registration</source>
        <translation>Registrierung</translation>
    </message>
    <message>
        <source>Segment</source>
        <translation>Segmentierung</translation>
    </message>
    <message>
        <source>Library</source>
        <translation>Bibliothek</translation>
    </message>
    <message>
        <source>Attachments</source>
        <translation>Anlagen</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>Approaches</source>
        <translation>Zugänge</translation>
    </message>
    <message>
        <source>Share</source>
        <translation>Weitergeben</translation>
    </message>
    <message>
        <source>Video</source>
        <translation>Video</translation>
    </message>
    <message>
        <source>Replay</source>
        <translation>Wiedergabe</translation>
    </message>
    <message>
        <source>Near the tool</source>
        <translation>Nahe am Werkzeug</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ActiveDeviceController</name>
    <message>
        <source>The pedal drills</source>
        <translation>Das Pedal bohrt</translation>
    </message>
    <message>
        <source>Taking up %1…</source>
        <translation>%1 wird übernommen…</translation>
    </message>
    <message>
        <source>%1 is there</source>
        <translation>%1 ist da</translation>
    </message>
    <message>
        <source>%1. The mouse leads the tool.</source>
        <translation>%1. Die Maus führt das Werkzeug.</translation>
    </message>
    <message>
        <source>The manual is in the browser</source>
        <translation>Das Handbuch ist im Browser</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::AddPartsDialog</name>
    <message>
        <source>name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>The name in the case. The file&apos;s own is not kept: it may be a patient&apos;s.</source>
        <translation>Der Name im Fall. Der eigene Name der Datei wird nicht behalten: Er könnte der eines Patienten sein.</translation>
    </message>
    <message>
        <source>named by the file</source>
        <translation>von der Datei benannt</translation>
    </message>
    <message>
        <source>where the file says</source>
        <translation>wo die Datei es angibt</translation>
    </message>
    <message>
        <source>on the %1</source>
        <translation>auf dem %1</translation>
    </message>
    <message>
        <source>on the MR %1</source>
        <translation>auf dem MR %1</translation>
    </message>
    <message>
        <source>The image on which it was drawn</source>
        <translation>Das Bild, auf dem es gezeichnet wurde</translation>
    </message>
    <message>
        <source>&amp;Names from a table…</source>
        <translation>&amp;Namen aus einer Tabelle…</translation>
    </message>
    <message>
        <source>A table of indices, names and colours: 3D Slicer (.ctbl), FreeSurfer or ITK-SNAP (.txt, .label), CSV, TSV, JSON</source>
        <translation>Eine Tabelle von Indizes, Namen und Farben: 3D Slicer (.ctbl), FreeSurfer oder ITK-SNAP (.txt, .label), CSV, TSV, JSON</translation>
    </message>
    <message>
        <source>Table of names</source>
        <translation>Namenstabelle</translation>
    </message>
    <message>
        <source>Tables of names (*.ctbl *.txt *.label *.csv *.tsv *.json);;All files (*)</source>
        <translation>Namenstabellen (*.ctbl *.txt *.label *.csv *.tsv *.json);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>named by “%1”</source>
        <translation>benannt durch „%1“</translation>
    </message>
    <message>
        <source>Each part needs a name.</source>
        <translation>Jeder Teil braucht einen Namen.</translation>
    </message>
    <message>
        <source>“%1” is taken; give another name.</source>
        <translation>„%1“ ist vergeben; wählen Sie einen anderen Namen.</translation>
    </message>
    <message>
        <source>1 structure, named by the file</source>
        <translation>1 Struktur, von der Datei benannt</translation>
    </message>
    <message>
        <source>%1 structures, named by the file</source>
        <translation>%1 Strukturen, von der Datei benannt</translation>
    </message>
    <message>
        <source>1 structure, without a name</source>
        <translation>1 Struktur, ohne Namen</translation>
    </message>
    <message>
        <source>%1 structures, none with a name</source>
        <translation>%1 Strukturen, keine mit Namen</translation>
    </message>
    <message>
        <source>%1 structures, 1 without a name</source>
        <translation>%1 Strukturen, 1 ohne Namen</translation>
    </message>
    <message>
        <source>%1 structures, %2 without a name</source>
        <translation>%1 Strukturen, %2 ohne Namen</translation>
    </message>
    <message>
        <source>One structure per &amp;object (%1)</source>
        <translation>Eine Struktur je &amp;Objekt (%1)</translation>
    </message>
    <message>
        <source>Each object of the file becomes a structure of its own, under the object&apos;s name, without words that may be a patient&apos;s name. A name given here is put before it. Otherwise all are one structure.</source>
        <translation>Jedes Objekt der Datei wird eine eigene Struktur unter dem Namen des Objekts, ohne Wörter, die zum Namen eines Patienten gehören können. Ein hier gegebener Name steht davor. Sonst sind alle eine Struktur.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::AppearancePanel</name>
    <message>
        <source>Whose transfer function is edited; a click on a curve chooses it too</source>
        <translation>Wessen Transferfunktion bearbeitet wird; auch ein Klick auf eine Kurve wählt sie</translation>
    </message>
    <message>
        <source>Structure</source>
        <translation>Struktur</translation>
    </message>
    <message>
        <source>The image whose intensities are read</source>
        <translation>Das Bild, dessen Intensitäten gelesen werden</translation>
    </message>
    <message>
        <source>Image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>rea&amp;ds</source>
        <translation>lies&amp;t</translation>
    </message>
    <message>
        <source>&amp;Preset</source>
        <translation>&amp;Vorgabe</translation>
    </message>
    <message>
        <source>Presets of the program and of this library</source>
        <translation>Vorgaben des Programms und dieser Bibliothek</translation>
    </message>
    <message>
        <source>F&amp;unction</source>
        <translation>F&amp;unktion</translation>
    </message>
    <message>
        <source>Copy, paste, files, reset</source>
        <translation>Kopieren, Einfügen, Dateien, Zurücksetzen</translation>
    </message>
    <message>
        <source>&amp;Add</source>
        <translation>&amp;Hinzufügen</translation>
    </message>
    <message>
        <source>A point halfway to the next one (Ins in the plot)</source>
        <translation>Ein Punkt auf halbem Weg zum nächsten (Einfg in der Kurve)</translation>
    </message>
    <message>
        <source>&amp;Remove</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>Removes the selected point (Del in the plot)</source>
        <translation>Entfernt den gewählten Punkt (Entf in der Kurve)</translation>
    </message>
    <message>
        <source>Colour of the selected point; without one, of the whole structure, whose points keep their shades</source>
        <translation>Farbe des gewählten Punkts; ohne einen die der ganzen Struktur, deren Punkte ihre Abstufungen behalten</translation>
    </message>
    <message>
        <source>Colour</source>
        <translation>Farbe</translation>
    </message>
    <message>
        <source>Intensity of the point, in the image&apos;s unit</source>
        <translation>Intensität des Punkts, in der Einheit des Bildes</translation>
    </message>
    <message>
        <source>Intensity</source>
        <translation>Intensität</translation>
    </message>
    <message>
        <source>Opacity of 1 mm of this tissue, 0 to 1</source>
        <translation>Deckkraft von 1 mm dieses Gewebes, 0 bis 1</translation>
    </message>
    <message>
        <source>Opacity of 1 mm</source>
        <translation>Deckkraft von 1 mm</translation>
    </message>
    <message>
        <source>Strength of the highlight on a surface there, 0 to 1</source>
        <translation>Stärke des Glanzlichts auf einer Oberfläche dort, 0 bis 1</translation>
    </message>
    <message>
        <source>Specular</source>
        <translation>Glanzlicht</translation>
    </message>
    <message>
        <source>&amp;Intensity</source>
        <translation>&amp;Intensität</translation>
    </message>
    <message>
        <source>&amp;Colour</source>
        <translation>&amp;Farbe</translation>
    </message>
    <message>
        <source>&amp;Opacity of 1 mm</source>
        <translation>&amp;Deckkraft von 1 mm</translation>
    </message>
    <message>
        <source>&amp;Specular</source>
        <translation>&amp;Glanzlicht</translation>
    </message>
    <message>
        <source>Of the surface. Below 100 % the inside is seen, with the opacities of the points</source>
        <translation>Der Oberfläche. Unter 100 % ist das Innere zu sehen, mit der Deckkraft der Punkte</translation>
    </message>
    <message>
        <source>Opacity of the surface</source>
        <translation>Deckkraft der Oberfläche</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>Sur&amp;face</source>
        <translation>&amp;Oberfläche</translation>
    </message>
    <message>
        <source>Tissue</source>
        <translation>Gewebe</translation>
    </message>
    <message>
        <source>Bone</source>
        <translation>Knochen</translation>
    </message>
    <message>
        <source>%1 (not registered)</source>
        <translation>%1 (nicht registriert)</translation>
    </message>
    <message>
        <source>The image whose intensities are read; the case has no MR beside it</source>
        <translation>Das Bild, dessen Intensitäten gelesen werden; der Fall hat daneben kein MR</translation>
    </message>
    <message>
        <source>Point %1 of %2</source>
        <translation>Punkt %1 von %2</translation>
    </message>
    <message>
        <source>One colour at every intensity</source>
        <translation>Eine Farbe bei jeder Intensität</translation>
    </message>
    <message>
        <source>1 point, not selected</source>
        <translation>1 Punkt, nicht gewählt</translation>
    </message>
    <message>
        <source>%1 points, none selected</source>
        <translation>%1 Punkte, keiner gewählt</translation>
    </message>
    <message>
        <source>. Function &gt; Fit to the histogram sets some.</source>
        <translation>. Funktion &gt; An das Histogramm anpassen setzt welche.</translation>
    </message>
    <message>
        <source>A space without tissue tints the bone around it: its colours count, its opacities do not.</source>
        <translation>Ein Raum ohne Gewebe tönt den Knochen um sich: Seine Farben zählen, seine Deckkraft nicht.</translation>
    </message>
    <message>
        <source>&amp;Delete</source>
        <translation>&amp;Löschen</translation>
    </message>
    <message>
        <source>Of this library</source>
        <translation>Dieser Bibliothek</translation>
    </message>
    <message>
        <source>&amp;Save as a preset…</source>
        <translation>Als Vorgabe &amp;speichern…</translation>
    </message>
    <message>
        <source>&amp;Copy</source>
        <translation>&amp;Kopieren</translation>
    </message>
    <message>
        <source>&amp;Paste</source>
        <translation>&amp;Einfügen</translation>
    </message>
    <message>
        <source>&amp;Import…</source>
        <translation>&amp;Importieren…</translation>
    </message>
    <message>
        <source>&amp;Export…</source>
        <translation>E&amp;xportieren…</translation>
    </message>
    <message>
        <source>&amp;Fit to the histogram</source>
        <translation>An das &amp;Histogramm anpassen</translation>
    </message>
    <message>
        <source>&amp;One colour</source>
        <translation>Eine &amp;Farbe</translation>
    </message>
    <message>
        <source>&amp;Reset to the preset “%1”</source>
        <translation>Auf die Vorgabe „%1“ &amp;zurücksetzen</translation>
    </message>
    <message>
        <source>Show the &amp;whole axis</source>
        <translation>&amp;Ganze Achse zeigen</translation>
    </message>
    <message>
        <source>Save as a preset</source>
        <translation>Als Vorgabe speichern</translation>
    </message>
    <message>
        <source>Name of the preset. It is kept in the library, for all of its cases, with colours, opacities, material and warning distance; a preset of that name is replaced.</source>
        <translation>Name der Vorgabe. Sie bleibt in der Bibliothek, für alle ihre Fälle, mit Farben, Deckkraft, Material und Warnabstand; eine Vorgabe dieses Namens wird ersetzt.</translation>
    </message>
    <message>
        <source>Import a transfer function</source>
        <translation>Transferfunktion importieren</translation>
    </message>
    <message>
        <source>Transfer functions (*.json);;All files (*)</source>
        <translation>Transferfunktionen (*.json);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Export the transfer function</source>
        <translation>Transferfunktion exportieren</translation>
    </message>
    <message>
        <source>Transfer functions (*.json)</source>
        <translation>Transferfunktionen (*.json)</translation>
    </message>
    <message>
        <source>cholesteatoma</source>
        <translation>Cholesteatom</translation>
    </message>
    <message>
        <source>tumour</source>
        <translation>Tumor</translation>
    </message>
    <message>
        <source>ossicle</source>
        <translation>Gehörknöchelchen</translation>
    </message>
    <message>
        <source>air-cells</source>
        <translation>Luftzellen</translation>
    </message>
    <message>
        <source>ear-canal</source>
        <translation>Gehörgang</translation>
    </message>
    <message>
        <source>vein</source>
        <translation>Vene</translation>
    </message>
    <message>
        <source>artery</source>
        <translation>Arterie</translation>
    </message>
    <message>
        <source>nerve</source>
        <translation>Nerv</translation>
    </message>
    <message>
        <source>inner-ear</source>
        <translation>Innenohr</translation>
    </message>
    <message>
        <source>dura</source>
        <translation>Dura</translation>
    </message>
    <message>
        <source>muscle</source>
        <translation>Muskel</translation>
    </message>
    <message>
        <source>bone</source>
        <translation>Knochen</translation>
    </message>
    <message>
        <source>bone-translucent</source>
        <translation>Knochen, durchscheinend</translation>
    </message>
    <message>
        <source>other</source>
        <translation>Sonstiges</translation>
    </message>
    <message>
        <source>Soft tissue</source>
        <translation>Weichgewebe</translation>
    </message>
    <message>
        <source>It has no surface: colours and opacities of the points are seen, these times the opacity of the whole. Below its first point it is transparent, as air must be.</source>
        <translation>Es hat keine Oberfläche: Zu sehen sind Farben und Deckkräfte der Punkte, diese mal der Deckkraft des Ganzen. Unterhalb des ersten Punkts ist es durchsichtig, wie Luft es sein muss.</translation>
    </message>
    <message>
        <source>soft-tissue</source>
        <translation>Weichgewebe</translation>
    </message>
    <message>
        <source>skin</source>
        <translation>Haut</translation>
    </message>
    <message>
        <source>The surface is opaque, so the opacities of this curve do not show, only its colours and highlights; lower the opacity of the surface to look inside.</source>
        <translation>Die Oberfläche ist deckend: Die Deckkraft dieser Kurve ist daher nicht zu sehen, nur ihre Farben und Glanzlichter; verringern Sie die Deckkraft der Oberfläche, um hineinzusehen.</translation>
    </message>
    <message>
        <source>O&amp;pacity</source>
        <translation>&amp;Deckkraft</translation>
    </message>
    <message>
        <source>Opacity</source>
        <translation>Deckkraft</translation>
    </message>
    <message>
        <source>Factor of the opacities of all points</source>
        <translation>Faktor der Deckkräfte aller Punkte</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ApproachPanel</name>
    <message>
        <source>%1 mm %2</source>
        <translation>%1 mm %2</translation>
    </message>
    <message>
        <source>diamond</source>
        <translation>Diamant</translation>
    </message>
    <message>
        <source>cutting</source>
        <translation>schneidend</translation>
    </message>
    <message>
        <source>of %1 %2</source>
        <translation>von %1 %2</translation>
    </message>
    <message>
        <source>recovered after the program had ended</source>
        <translation>nach einem Abbruch des Programms wiederhergestellt</translation>
    </message>
    <message>
        <source>Strokes of all approaches</source>
        <translation>Bohrzüge aller Zugänge</translation>
    </message>
    <message>
        <source>Stroke</source>
        <translation>Bohrzug</translation>
    </message>
    <message>
        <source>Removed</source>
        <translation>Abgetragen</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Burr</source>
        <translation>Fräse</translation>
    </message>
    <message>
        <source>Strokes of the present approach that are done</source>
        <translation>Ausgeführte Bohrzüge des jetzigen Zugangs</translation>
    </message>
    <message>
        <source>The strokes of the present approach: drag, or the arrow keys, to go back and forth through them</source>
        <translation>Die Bohrzüge des jetzigen Zugangs: Ziehen oder Pfeiltasten gehen durch sie vor und zurück</translation>
    </message>
    <message>
        <source>&amp;Branch here…</source>
        <translation>&amp;Hier abzweigen…</translation>
    </message>
    <message>
        <source>A new approach from the present state; the present one stays (Ctrl+B)</source>
        <translation>Ein neuer Zugang vom jetzigen Stand aus; der jetzige bleibt (Strg+B)</translation>
    </message>
    <message>
        <source>&amp;Compare</source>
        <translation>&amp;Vergleichen</translation>
    </message>
    <message>
        <source>The present approach with the chosen one, or with the one beside it: side by side and as difference (Ctrl+D)</source>
        <translation>Der jetzige Zugang mit dem gewählten oder dem daneben: nebeneinander und als Unterschied (Strg+D)</translation>
    </message>
    <message>
        <source>&amp;Rename…</source>
        <translation>&amp;Umbenennen…</translation>
    </message>
    <message>
        <source>Another name for the approach</source>
        <translation>Ein anderer Name für den Zugang</translation>
    </message>
    <message>
        <source>&amp;Delete</source>
        <translation>&amp;Löschen</translation>
    </message>
    <message>
        <source>Takes the approach out of the case; Undo brings it back</source>
        <translation>Nimmt den Zugang aus dem Fall; Rückgängig holt ihn zurück</translation>
    </message>
    <message>
        <source>1 stroke</source>
        <translation>1 Bohrzug</translation>
    </message>
    <message>
        <source>%1 strokes</source>
        <translation>%1 Bohrzüge</translation>
    </message>
    <message>
        <source>Set aside by drilling after an undo</source>
        <translation>Durch Bohren nach einem Rückgängig beiseitegelegt</translation>
    </message>
    <message>
        <source>Untouched</source>
        <translation>Unberührt</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>Set to %1 turns a minute; by the pedal %2 on average, at most %3</source>
        <translation>Eingestellt auf %1 Umdrehungen je Minute; durch das Pedal im Mittel %2, höchstens %3</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ArchiveDialog</name>
    <message>
        <source>File of the archive</source>
        <translation>Datei des Archivs</translation>
    </message>
    <message>
        <source>&amp;Plan only, without images and structures</source>
        <translation>Nur der &amp;Plan, ohne Bilder und Strukturen</translation>
    </message>
    <message>
        <source>with its &amp;note</source>
        <translation>mit der &amp;Notiz</translation>
    </message>
    <message>
        <source>with its &amp;videos, which may show or name the patient</source>
        <translation>mit den &amp;Videos, die den Patienten zeigen oder nennen können</translation>
    </message>
    <message>
        <source>with its PDF&amp;s, which may name the patient</source>
        <translation>mit den PD&amp;Fs, die den Patienten nennen können</translation>
    </message>
    <message>
        <source>with &amp;dates and times, and who signed registrations</source>
        <translation>mit &amp;Daten und Zeiten und wer Registrierungen freigab</translation>
    </message>
    <message>
        <source>Archive “%1”</source>
        <translation>„%1“ archivieren</translation>
    </message>
    <message>
        <source>A small file with strokes, views and appearance. It is restored where the very same CT is</source>
        <translation>Eine kleine Datei mit Bohrzügen, Ansichten und Darstellung. Sie wird dort wiederhergestellt, wo genau dasselbe CT ist</translation>
    </message>
    <message>
        <source>The dates of the planned operation and of attachments, the times of strokes, names and times of sign-offs</source>
        <translation>Die Daten der geplanten Operation und der Anlagen, die Zeiten der Bohrzüge, Namen und Zeiten von Freigaben</translation>
    </message>
    <message>
        <source>What the archive tells of the patient</source>
        <translation>Was das Archiv über den Patienten aussagt</translation>
    </message>
    <message>
        <source>&amp;File:</source>
        <translation>Da&amp;tei:</translation>
    </message>
    <message>
        <source>What:</source>
        <translation>Was:</translation>
    </message>
    <message>
        <source>&amp;Archive</source>
        <translation>&amp;Archivieren</translation>
    </message>
    <message>
        <source>What is in the file:</source>
        <translation>Was in der Datei ist:</translation>
    </message>
    <message>
        <source>Give the file a name.</source>
        <translation>Geben Sie der Datei einen Namen.</translation>
    </message>
    <message>
        <source>There is no such folder.</source>
        <translation>Diesen Ordner gibt es nicht.</translation>
    </message>
    <message>
        <source>Put a&amp;ir in place of the face</source>
        <translation>Das &amp;Gesicht durch Luft ersetzen</translation>
    </message>
    <message>
        <source>Put air in place of the &amp;face, and leave out %1</source>
        <translation>Das &amp;Gesicht durch Luft ersetzen; nicht mit ins Archiv: %1</translation>
    </message>
    <message>
        <source>In front of a plane about 50 mm behind the tip of the nose. What is segmented or drilled and the temporal bones stay; the case here does not change</source>
        <translation>Vor einer Ebene etwa 50 mm hinter der Nasenspitze. Was segmentiert oder gebohrt ist und die Felsenbeine bleiben; der Fall hier ändert sich nicht</translation>
    </message>
    <message>
        <source>&amp;Archive with the face</source>
        <translation>Mit dem Gesicht &amp;archivieren</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::AttachmentsController</name>
    <message>
        <source>Recordings, PNG, PDF, video %1</source>
        <translation>Aufzeichnungen, PNG, PDF, Video %1</translation>
    </message>
    <message>
        <source>The same, as a link: the file stays where it is %1</source>
        <translation>Dasselbe als Verknüpfung: Die Datei bleibt, wo sie ist %1</translation>
    </message>
    <message>
        <source>Attach to “%1”</source>
        <translation>An „%1“ anhängen</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
    <message>
        <source>One at a time: a file is being read already</source>
        <translation>Eines nach dem anderen: Es wird schon eine Datei gelesen</translation>
    </message>
    <message>
        <source>“%1” is attached; the path of its file, which the case keeps, may name the patient. It stays in this library</source>
        <translation>„%1“ ist angehängt; der Pfad der Datei, den der Fall behält, kann den Patienten nennen. Er bleibt in dieser Bibliothek</translation>
    </message>
    <message>
        <source>“%1” is attached; a video may show or name the patient, and stays here when the case is archived or sent, unless asked</source>
        <translation>„%1“ ist angehängt; ein Video kann den Patienten zeigen oder nennen und bleibt hier, wenn der Fall archiviert oder gesendet wird, außer auf Wunsch</translation>
    </message>
    <message>
        <source>“%1” is attached; a PDF may name the patient, also in its metadata, and stays here when the case is archived or sent, unless asked</source>
        <translation>„%1“ ist angehängt; ein PDF kann den Patienten nennen, auch in seinen Metadaten, und bleibt hier, wenn der Fall archiviert oder gesendet wird, außer auf Wunsch</translation>
    </message>
    <message>
        <source>“%1” is attached</source>
        <translation>„%1“ ist angehängt</translation>
    </message>
    <message>
        <source>“%1” is being saved</source>
        <translation>„%1“ wird gespeichert</translation>
    </message>
    <message>
        <source>Save “%1”</source>
        <translation>„%1“ speichern</translation>
    </message>
    <message>
        <source>“%1” is in %2</source>
        <translation>„%1“ ist in %2</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>What there is to say of “%1”:</source>
        <translation>Was zu „%1“ zu sagen ist:</translation>
    </message>
    <message>
        <source>Attachments</source>
        <translation>Anlagen</translation>
    </message>
    <message>
        <source>Take “%1” out of the case?</source>
        <translation>„%1“ aus dem Fall nehmen?</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::AttachmentsPanel</name>
    <message>
        <source>Recording</source>
        <translation>Aufzeichnung</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>Video</source>
        <translation>Video</translation>
    </message>
    <message>
        <source>Document</source>
        <translation>Dokument</translation>
    </message>
    <message>
        <source>Attachments</source>
        <translation>Anlagen</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>Date and note</source>
        <translation>Datum und Notiz</translation>
    </message>
    <message>
        <source>&amp;Attach…</source>
        <translation>An&amp;hängen…</translation>
    </message>
    <message>
        <source>A file goes with the case</source>
        <translation>Eine Datei geht mit dem Fall</translation>
    </message>
    <message>
        <source>&amp;Screenshot</source>
        <translation>&amp;Bildschirmfoto</translation>
    </message>
    <message>
        <source>Attaches the 3D picture</source>
        <translation>Hängt das 3D-Bild an</translation>
    </message>
    <message>
        <source>&amp;Recording</source>
        <translation>Auf&amp;zeichnung</translation>
    </message>
    <message>
        <source>Attaches the last recording of the tool (Drill &gt; Record session…)</source>
        <translation>Hängt die letzte Aufzeichnung des Werkzeugs an (Bohren &gt; Sitzung aufzeichnen…)</translation>
    </message>
    <message>
        <source>Save &amp;file…</source>
        <translation>Datei &amp;speichern…</translation>
    </message>
    <message>
        <source>Writes it to a file</source>
        <translation>Schreibt es in eine Datei</translation>
    </message>
    <message>
        <source>&amp;Note…</source>
        <translation>&amp;Notiz…</translation>
    </message>
    <message>
        <source>What there is to say of it</source>
        <translation>Was dazu zu sagen ist</translation>
    </message>
    <message>
        <source>Re&amp;move</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>Takes it out of the case</source>
        <translation>Nimmt es aus dem Fall</translation>
    </message>
    <message>
        <source>%1, linked</source>
        <translation>%1, verknüpft</translation>
    </message>
    <message>
        <source>%1, its file is %2</source>
        <translation>%1, seine Datei ist %2</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::AxesDialog</name>
    <message>
        <source>Left</source>
        <translation>Links</translation>
    </message>
    <message>
        <source>Right</source>
        <translation>Rechts</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Hinten</translation>
    </message>
    <message>
        <source>Front</source>
        <translation>Vorn</translation>
    </message>
    <message>
        <source>Head</source>
        <translation>Kopf</translation>
    </message>
    <message>
        <source>Feet</source>
        <translation>Füße</translation>
    </message>
    <message>
        <source>MRs with their registrations: %1</source>
        <translation>MRs mit ihren Registrierungen: %1</translation>
    </message>
    <message>
        <source>Drawn on an MR: %1</source>
        <translation>Auf einer MR gezeichnet: %1</translation>
    </message>
    <message>
        <source>Strokes: %1</source>
        <translation>Bohrzüge: %1</translation>
    </message>
    <message>
        <source>Measurements: %1</source>
        <translation>Messungen: %1</translation>
    </message>
    <message>
        <source>Attachments: %1</source>
        <translation>Anlagen: %1</translation>
    </message>
    <message>
        <source>Saved views: %1</source>
        <translation>Gespeicherte Ansichten: %1</translation>
    </message>
    <message>
        <source>All of this case comes along.</source>
        <translation>Alles in diesem Fall kommt mit.</translation>
    </message>
    <message>
        <source>Stays with this case alone:</source>
        <translation>Nur bei diesem Fall bleibt:</translation>
    </message>
    <message>
        <source>Correct the axes</source>
        <translation>Achsen korrigieren</translation>
    </message>
    <message>
        <source>For an image whose file states wrong axes: it is mirrored, or lies otherwise than the letters say. What is right becomes a new case; “%1” stays as it is. Which ear it is will be asked again.</source>
        <translation>Für ein Bild, dessen Datei falsche Achsen nennt: Es ist gespiegelt oder liegt anders, als die Buchstaben sagen. Das richtige wird ein neuer Fall; „%1“ bleibt, wie er ist. Welches Ohr es ist, wird neu gefragt.</translation>
    </message>
    <message>
        <source>What is now &amp;left is really:</source>
        <translation>Was jetzt &amp;links ist, ist wirklich:</translation>
    </message>
    <message>
        <source>What is now &amp;back is really:</source>
        <translation>Was jetzt &amp;hinten ist, ist wirklich:</translation>
    </message>
    <message>
        <source>What is now &amp;head is really:</source>
        <translation>Was jetzt &amp;Kopf ist, ist wirklich:</translation>
    </message>
    <message>
        <source>Where this side of the image really is. Another one that had this direction takes the one that was here</source>
        <translation>Wo diese Seite des Bildes wirklich ist. Eine andere, die diese Richtung hatte, bekommt die bisherige</translation>
    </message>
    <message>
        <source>Exchange left and &amp;right</source>
        <translation>Links und &amp;rechts tauschen</translation>
    </message>
    <message>
        <source>Of a mirrored image: the side of the operation is at stake</source>
        <translation>Bei einem gespiegelten Bild: Es geht um die Seite der Operation</translation>
    </message>
    <message>
        <source>Exchange head and &amp;feet</source>
        <translation>Kopf und &amp;Füße tauschen</translation>
    </message>
    <message>
        <source>Of an image whose slices are in the wrong order, which mirrors it, too</source>
        <translation>Bei einem Bild, dessen Schichten verkehrt geordnet sind, was es auch spiegelt</translation>
    </message>
    <message>
        <source>&amp;Turn front to back</source>
        <translation>&amp;Vorn nach hinten drehen</translation>
    </message>
    <message>
        <source>Half a turn about the long axis, as of a patient who lay face down: front and back are exchanged, and left and right</source>
        <translation>Eine halbe Drehung um die Längsachse, wie bei einem Patienten, der auf dem Bauch lag: vorn und hinten werden getauscht, und links und rechts</translation>
    </message>
    <message>
        <source>&amp;Make the corrected case</source>
        <translation>Korrigierten Fall &amp;anlegen</translation>
    </message>
    <message>
        <source>A new case in the library, which is opened</source>
        <translation>Ein neuer Fall in der Bibliothek, der geöffnet wird</translation>
    </message>
    <message>
        <source>As it is. Choose what is wrong.</source>
        <translation>Wie es ist. Wählen Sie, was falsch ist.</translation>
    </message>
    <message>
        <source>The anatomy is mirrored: a left ear becomes a right one.</source>
        <translation>Die Anatomie wird gespiegelt: Aus einem linken Ohr wird ein rechtes.</translation>
    </message>
    <message>
        <source>The anatomy is turned, and not mirrored.</source>
        <translation>Die Anatomie wird gedreht und nicht gespiegelt.</translation>
    </message>
    <message>
        <source>Goes along: %1</source>
        <translation>Folgt mit: %1</translation>
    </message>
    <message>
        <source>Is to be registered again: %1</source>
        <translation>Ist neu zu registrieren: %1</translation>
    </message>
    <message>
        <source>For a file that states wrong axes: it is mirrored, or lies otherwise than the letters say. “%1” is corrected in this case; Ctrl+Z takes that back.</source>
        <translation>Für eine Datei, die falsche Achsen nennt: Sie ist gespiegelt oder liegt anders, als die Buchstaben sagen. „%1“ wird in diesem Fall korrigiert; Strg+Z nimmt das zurück.</translation>
    </message>
    <message>
        <source>C&amp;orrect the axes</source>
        <translation>Achsen &amp;korrigieren</translation>
    </message>
    <message>
        <source>It is mirrored. The image on which it lies stays as it is.</source>
        <translation>Es wird gespiegelt. Das Bild, auf dem es liegt, bleibt, wie es ist.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::BackgroundWork</name>
    <message>
        <source>An unexpected fault.</source>
        <translation>Ein unerwarteter Fehler.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::BoxNumbers</name>
    <message>
        <source>&amp;x, to the left</source>
        <translation>&amp;x, nach links</translation>
    </message>
    <message>
        <source>&amp;y, to the back</source>
        <translation>&amp;y, nach hinten</translation>
    </message>
    <message>
        <source>&amp;z, to the head</source>
        <translation>&amp;z, zum Kopf</translation>
    </message>
    <message>
        <source>Where the box begins</source>
        <translation>Wo der Quader beginnt</translation>
    </message>
    <message>
        <source>Where the box ends</source>
        <translation>Wo der Quader endet</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::BranchController</name>
    <message>
        <source>%1: %2 %3, %4 mm³</source>
        <translation>%1: %2 %3, %4 mm³</translation>
    </message>
    <message>
        <source>stroke</source>
        <translation>Bohrzug</translation>
    </message>
    <message>
        <source>strokes</source>
        <translation>Bohrzüge</translation>
    </message>
    <message>
        <source> (set aside)</source>
        <translation> (beiseitegelegt)</translation>
    </message>
    <message>
        <source>&amp;New approach from here…</source>
        <translation>&amp;Neuer Zugang von hier…</translation>
    </message>
    <message>
        <source>Ne&amp;xt approach</source>
        <translation>Nä&amp;chster Zugang</translation>
    </message>
    <message>
        <source>&amp;Previous approach</source>
        <translation>V&amp;origer Zugang</translation>
    </message>
    <message>
        <source>&amp;Compare</source>
        <translation>&amp;Vergleichen</translation>
    </message>
    <message>
        <source>C&amp;ompare with</source>
        <translation>Vergleichen &amp;mit</translation>
    </message>
    <message>
        <source>&amp;Rename the approach…</source>
        <translation>Zugang &amp;umbenennen…</translation>
    </message>
    <message>
        <source>&amp;Delete the approach</source>
        <translation>Zugang &amp;löschen</translation>
    </message>
    <message>
        <source>Drill another way from the present state; the present one stays</source>
        <translation>Vom jetzigen Stand aus anders bohren; der jetzige bleibt</translation>
    </message>
    <message>
        <source>The present approach and the one that was left last, side by side and as difference</source>
        <translation>Der jetzige und der zuletzt verlassene Zugang, nebeneinander und als Unterschied</translation>
    </message>
    <message>
        <source>Takes the present approach out of the case; Undo brings it back</source>
        <translation>Nimmt den jetzigen Zugang aus dem Fall; Rückgängig holt ihn zurück</translation>
    </message>
    <message>
        <source>Open a case first</source>
        <translation>Öffnen Sie zuerst einen Fall</translation>
    </message>
    <message>
        <source>The case has one approach only</source>
        <translation>Der Fall hat nur einen Zugang</translation>
    </message>
    <message>
        <source>Approach %1</source>
        <translation>Zugang %1</translation>
    </message>
    <message>
        <source>New approach</source>
        <translation>Neuer Zugang</translation>
    </message>
    <message>
        <source>On the new approach %1</source>
        <translation>Auf dem neuen Zugang %1</translation>
    </message>
    <message>
        <source>Rename the approach</source>
        <translation>Zugang umbenennen</translation>
    </message>
    <message>
        <source>New name of “%1”:</source>
        <translation>Neuer Name von „%1“:</translation>
    </message>
    <message>
        <source>“%1” is now “%2”</source>
        <translation>„%1“ heißt jetzt „%2“</translation>
    </message>
    <message>
        <source>The approach “%1” is deleted; Undo brings it back</source>
        <translation>Der Zugang „%1“ ist gelöscht; Rückgängig holt ihn zurück</translation>
    </message>
    <message>
        <source>Approach</source>
        <translation>Zugang</translation>
    </message>
    <message>
        <source>Name of the approach that begins here, after one stroke:</source>
        <translation>Name des Zugangs, der hier nach einem Bohrzug beginnt:</translation>
    </message>
    <message>
        <source>Name of the approach that begins here, after %1 strokes:</source>
        <translation>Name des Zugangs, der hier nach %1 Bohrzügen beginnt:</translation>
    </message>
    <message>
        <source>Approach %1, strokes drilled: %2 of %3</source>
        <translation>Zugang %1, gebohrte Bohrzüge: %2 von %3</translation>
    </message>
    <message>
        <source>%1; the tool was put away</source>
        <translation>%1; das Werkzeug wurde weggelegt</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::CaseDocumentController</name>
    <message>
        <source>%1 “%2”</source>
        <translation>%1 „%2“</translation>
    </message>
    <message>
        <source>%1 MB</source>
        <translation>%1 MB</translation>
    </message>
    <message>
        <source>MR</source>
        <translation>MR</translation>
    </message>
    <message>
        <source>CT</source>
        <translation>CT</translation>
    </message>
    <message>
        <source>MR “%1”</source>
        <translation>MR „%1“</translation>
    </message>
    <message>
        <source>structure</source>
        <translation>Struktur</translation>
    </message>
    <message>
        <source>structures</source>
        <translation>Strukturen</translation>
    </message>
    <message>
        <source>mesh</source>
        <translation>Netz</translation>
    </message>
    <message>
        <source>meshes</source>
        <translation>Netze</translation>
    </message>
    <message>
        <source>nothing drilled</source>
        <translation>nichts gebohrt</translation>
    </message>
    <message>
        <source>stroke</source>
        <translation>Bohrzug</translation>
    </message>
    <message>
        <source>strokes</source>
        <translation>Bohrzüge</translation>
    </message>
    <message>
        <source>, looks and registrations; no images, structures or meshes: it is restored where the very same CT is</source>
        <translation>, Darstellung und Registrierungen; keine Bilder, Strukturen oder Netze: Er wird dort wiederhergestellt, wo genau dasselbe CT ist</translation>
    </message>
    <message>
        <source>Stopped; nothing was changed</source>
        <translation>Angehalten; nichts wurde geändert</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>Erneut versuchen</translation>
    </message>
    <message>
        <source>Another folder…</source>
        <translation>Anderer Ordner…</translation>
    </message>
    <message>
        <source>Library in another folder</source>
        <translation>Bibliothek in einem anderen Ordner</translation>
    </message>
    <message>
        <source>Quit without saving</source>
        <translation>Ohne Speichern beenden</translation>
    </message>
    <message>
        <source>Go on working</source>
        <translation>Weiterarbeiten</translation>
    </message>
    <message>
        <source>Saved as %1</source>
        <translation>Gespeichert als %1</translation>
    </message>
    <message>
        <source>Put back</source>
        <translation>Zurücklegen</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Prepare them</source>
        <translation>Vorbereiten</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>The structures are being prepared: %1, %2 %</source>
        <translation>Die Strukturen werden vorbereitet: %1, %2 %</translation>
    </message>
    <message>
        <source>The structures were not prepared: they are not shown and felt as the list says.</source>
        <translation>Die Strukturen wurden nicht vorbereitet: Sie werden nicht so gezeigt und gefühlt, wie die Liste sagt.</translation>
    </message>
    <message>
        <source>The structures could not be prepared: %1</source>
        <translation>Die Strukturen konnten nicht vorbereitet werden: %1</translation>
    </message>
    <message>
        <source>Not saved: %1 The work is still open in this window.</source>
        <translation>Nicht gespeichert: %1 Die Arbeit ist in diesem Fenster noch offen.</translation>
    </message>
    <message>
        <source>Petrous</source>
        <translation>Petrous</translation>
    </message>
    <message>
        <source>One at a time: something is being read already</source>
        <translation>Eines nach dem anderen: Es wird schon etwas gelesen</translation>
    </message>
    <message>
        <source>“%1” is the archive of a whole case; open it alone.</source>
        <translation>„%1“ ist das Archiv eines ganzen Falls; öffnen Sie es allein.</translation>
    </message>
    <message>
        <source>Stopping…</source>
        <translation>Wird angehalten…</translation>
    </message>
    <message>
        <source>The open case is not saved yet; it stays open</source>
        <translation>Der offene Fall ist noch nicht gespeichert; er bleibt offen</translation>
    </message>
    <message>
        <source>Opening %1</source>
        <translation>%1 wird geöffnet</translation>
    </message>
    <message>
        <source>Opened %1.  Drag turns the patient, the wheel zooms, D switches to the drill.</source>
        <translation>%1 ist geöffnet.  Ziehen dreht den Patienten, das Rad zoomt, D wechselt zum Bohren.</translation>
    </message>
    <message>
        <source>Looking at the files</source>
        <translation>Dateien werden angesehen</translation>
    </message>
    <message>
        <source>What is this?</source>
        <translation>Was ist das?</translation>
    </message>
    <message>
        <source>What is “%1”? It %2.</source>
        <translation>Was ist „%1“? Es %2.</translation>
    </message>
    <message>
        <source>A CT or cone beam begins a case of its own; “%1” is saved and stays in the library.</source>
        <translation>Ein CT oder DVT beginnt einen eigenen Fall; „%1“ wird gespeichert und bleibt in der Bibliothek.</translation>
    </message>
    <message>
        <source>A case begins with a CT or cone beam, to which an MR can come; with an MR alone where there is no CT.</source>
        <translation>Ein Fall beginnt mit einem CT oder DVT, zu dem ein MR kommen kann; mit einem MR allein, wo es kein CT gibt.</translation>
    </message>
    <message>
        <source>&amp;CT: a new case</source>
        <translation>&amp;CT: ein neuer Fall</translation>
    </message>
    <message>
        <source>&amp;MR of “%1”</source>
        <translation>&amp;MR von „%1“</translation>
    </message>
    <message>
        <source>&amp;MR: a new case</source>
        <translation>&amp;MR: ein neuer Fall</translation>
    </message>
    <message>
        <source>&amp;Structures of “%1”</source>
        <translation>&amp;Strukturen von „%1“</translation>
    </message>
    <message>
        <source>A case without a CT?</source>
        <translation>Ein Fall ohne CT?</translation>
    </message>
    <message>
        <source>There is no CT here. Begin the case with the MR “%1”?</source>
        <translation>Hier ist kein CT. Den Fall mit dem MR „%1“ beginnen?</translation>
    </message>
    <message>
        <source>Its surface is then where tissue begins, not bone. If there is a CT of the patient, open that first, and the MR comes to it.</source>
        <translation>Seine Oberfläche ist dann dort, wo Gewebe beginnt, nicht Knochen. Gibt es ein CT des Patienten, öffnen Sie dieses zuerst; das MR kommt dann dazu.</translation>
    </message>
    <message>
        <source>&amp;Begin with the MR</source>
        <translation>Mit dem MR &amp;beginnen</translation>
    </message>
    <message>
        <source>Region of the %1</source>
        <translation>Ausschnitt des %1</translation>
    </message>
    <message>
        <source>“%1” is no %2: it %3. File &gt; Open takes it for what it is.</source>
        <translation>„%1“ ist kein %2: Es %3. Datei &gt; Öffnen nimmt es als das, was es ist.</translation>
    </message>
    <message>
        <source>Add to the case “%1”?</source>
        <translation>Zum Fall „%1“ hinzufügen?</translation>
    </message>
    <message>
        <source>Make the case “%1”</source>
        <translation>Den Fall „%1“ anlegen</translation>
    </message>
    <message>
        <source>It must be of the same patient.%1</source>
        <translation>Es muss vom selben Patienten sein.%1</translation>
    </message>
    <message>
        <source>&amp;Add to “%1”</source>
        <translation>Zu „%1“ &amp;hinzufügen</translation>
    </message>
    <message>
        <source>&amp;Make the case</source>
        <translation>Fall &amp;anlegen</translation>
    </message>
    <message>
        <source>“%1” and “%2” are both CTs, and a case has one; open them one after the other.</source>
        <translation>„%1“ und „%2“ sind beide CTs, und ein Fall hat nur eines; öffnen Sie sie nacheinander.</translation>
    </message>
    <message>
        <source>A case begins with a CT, and there is none here: %1. Open the patient&apos;s CT first, then this.</source>
        <translation>Ein Fall beginnt mit einem CT, und hier ist keines: %1. Öffnen Sie zuerst das CT des Patienten, dann dies.</translation>
    </message>
    <message>
        <source>Making the case %1</source>
        <translation>Der Fall %1 wird angelegt</translation>
    </message>
    <message>
        <source>Saving %1 in the library…</source>
        <translation>%1 wird in der Bibliothek gespeichert…</translation>
    </message>
    <message>
        <source>%1 is in the library; %2 stays open</source>
        <translation>%1 ist in der Bibliothek; %2 bleibt offen</translation>
    </message>
    <message>
        <source>Adding to %1</source>
        <translation>Wird zu %1 hinzugefügt</translation>
    </message>
    <message>
        <source>%1 was not added: the case “%2” is not open any more.</source>
        <translation>%1 wurde nicht hinzugefügt: Der Fall „%2“ ist nicht mehr offen.</translation>
    </message>
    <message>
        <source>Added to %1: %2</source>
        <translation>Zu %1 hinzugefügt: %2</translation>
    </message>
    <message>
        <source>Added to %1: %2; %3</source>
        <translation>Zu %1 hinzugefügt: %2; %3</translation>
    </message>
    <message>
        <source>%1 was not added, as something else is being read; add it again.</source>
        <translation>%1 wurde nicht hinzugefügt, da etwas anderes gelesen wird; fügen Sie es erneut hinzu.</translation>
    </message>
    <message>
        <source>%1 files were not added.</source>
        <translation>%1 Dateien wurden nicht hinzugefügt.</translation>
    </message>
    <message>
        <source> (%1 mm³ by the file)</source>
        <translation> (%1 mm³ laut Datei)</translation>
    </message>
    <message>
        <source>Structures</source>
        <translation>Strukturen</translation>
    </message>
    <message>
        <source>Not all are as the file has them.</source>
        <translation>Nicht alle sind so, wie die Datei sie hat.</translation>
    </message>
    <message>
        <source>Which side is left?</source>
        <translation>Welche Seite ist links?</translation>
    </message>
    <message>
        <source>“%1” does not say which side of the patient is left. How do its axes run?</source>
        <translation>„%1“ sagt nicht, welche Seite des Patienten links ist. Wie verlaufen die Achsen?</translation>
    </message>
    <message>
        <source>A wrong answer turns it by half a turn: what is left is then shown on the right, and what is in front at the back, and nothing in the picture has to look odd. Answer only if you know it; otherwise export the file again together with its geometry.</source>
        <translation>Eine falsche Antwort dreht es um eine halbe Drehung: Was links ist, erscheint dann rechts, was vorn ist, hinten, und nichts im Bild muss auffallen. Antworten Sie nur, wenn Sie es wissen; exportieren Sie sonst die Datei erneut zusammen mit ihrer Geometrie.</translation>
    </message>
    <message>
        <source>To the &amp;left and back (LPS: DICOM, ITK)</source>
        <translation>Nach &amp;links und hinten (LPS: DICOM, ITK)</translation>
    </message>
    <message>
        <source>To the &amp;right and front (RAS: NIfTI, Slicer)</source>
        <translation>Nach &amp;rechts und vorn (RAS: NIfTI, Slicer)</translation>
    </message>
    <message>
        <source>On which image was it drawn?</source>
        <translation>Auf welchem Bild wurde es gezeichnet?</translation>
    </message>
    <message>
        <source>“%1” was drawn in another frame of reference than the images of this case.</source>
        <translation>„%1“ wurde in einem anderen Bezugssystem gezeichnet als die Bilder dieses Falls.</translation>
    </message>
    <message>
        <source>It may have been drawn on another scan of the patient, and would then lie in the wrong place. Where another program or library gave this very %1 new identifiers, it lies where it belongs. Look at the slices afterwards.</source>
        <translation>Es kann auf einer anderen Aufnahme des Patienten gezeichnet worden sein und läge dann am falschen Ort. Hat ein anderes Programm oder eine andere Bibliothek genau diesem %1 neue Kennungen gegeben, so liegt es richtig. Sehen Sie danach die Schichten an.</translation>
    </message>
    <message>
        <source>On the &amp;%1</source>
        <translation>Auf dem &amp;%1</translation>
    </message>
    <message>
        <source>On %1</source>
        <translation>Auf %1</translation>
    </message>
    <message>
        <source>Add the &amp;others without it</source>
        <translation>Die &amp;anderen ohne es hinzufügen</translation>
    </message>
    <message>
        <source>Add the &amp;others without them</source>
        <translation>Die &amp;anderen ohne sie hinzufügen</translation>
    </message>
    <message>
        <source>Another patient?</source>
        <translation>Ein anderer Patient?</translation>
    </message>
    <message>
        <source>Of another patient, it would put an anatomy into the picture that is not this one&apos;s, and the plan would be wrong where it counts. Look at the files first. Add it only if you know that it is this patient&apos;s, as where one of the files was de-identified or the patient&apos;s name was changed; a note in the case will say so.</source>
        <translation>Von einem anderen Patienten brächte es eine fremde Anatomie ins Bild, und der Plan wäre falsch, wo es darauf ankommt. Sehen Sie zuerst die Dateien an. Fügen Sie es nur hinzu, wenn Sie wissen, dass es von diesem Patienten ist, etwa weil eine der Dateien de-identifiziert oder der Name geändert wurde; eine Notiz im Fall wird es festhalten.</translation>
    </message>
    <message>
        <source>It is this &amp;patient&apos;s: add it</source>
        <translation>Es ist von diesem &amp;Patienten: hinzufügen</translation>
    </message>
    <message>
        <source>Coordinates of a mesh</source>
        <translation>Koordinaten eines Netzes</translation>
    </message>
    <message>
        <source>Which coordinate system does the mesh “%1” use?</source>
        <translation>Welches Koordinatensystem hat das Netz „%1“?</translation>
    </message>
    <message>
        <source>Add as &amp;%1</source>
        <translation>Als &amp;%1 hinzufügen</translation>
    </message>
    <message>
        <source>“%1” was taken out of the case. Until the case is closed it can be put back.</source>
        <translation>„%1“ wurde aus dem Fall genommen. Bis der Fall geschlossen wird, lässt es sich zurücklegen.</translation>
    </message>
    <message>
        <source>“%1” was taken out of the case</source>
        <translation>„%1“ wurde aus dem Fall genommen</translation>
    </message>
    <message>
        <source>“%1” is in the case again</source>
        <translation>„%1“ ist wieder im Fall</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Umbenennen</translation>
    </message>
    <message>
        <source>New name of “%1”:</source>
        <translation>Neuer Name von „%1“:</translation>
    </message>
    <message>
        <source>“%1” is called “%2” now</source>
        <translation>„%1“ heißt jetzt „%2“</translation>
    </message>
    <message>
        <source>The structures are being prepared…</source>
        <translation>Die Strukturen werden vorbereitet…</translation>
    </message>
    <message>
        <source>Damaged: %1. Do not rely on what is shown of it; nothing is drilled in this case until it is whole and opened again.</source>
        <translation>Beschädigt: %1. Verlassen Sie sich nicht auf das, was davon gezeigt wird; in diesem Fall wird nicht gebohrt, bis er heil ist und neu geöffnet wurde.</translation>
    </message>
    <message>
        <source>The case is open with what is left of it: description, attachments, structures and strokes; where its image was is nothing. Import the same image again, as a case of its own, or restore the file from a copy of the library: then open this case again. Or remove it (Library &gt; Cases).</source>
        <translation>Der Fall ist mit dem geöffnet, was von ihm übrig ist: Beschreibung, Anlagen, Strukturen und Bohrzüge; wo sein Bild war, ist nichts. Importieren Sie dasselbe Bild erneut, als eigenen Fall, oder stellen Sie die Datei aus einer Kopie der Bibliothek wieder her: Öffnen Sie dann diesen Fall erneut. Oder entfernen Sie ihn (Bibliothek &gt; Fälle).</translation>
    </message>
    <message>
        <source>Left out, neither shown nor felt: %1.</source>
        <translation>Ausgelassen, weder gezeigt noch gefühlt: %1.</translation>
    </message>
    <message>
        <source>Damaged, and not applied: %1.</source>
        <translation>Beschädigt und nicht angewandt: %1.</translation>
    </message>
    <message>
        <source>The case is shown without its last stroke, which stays in it.</source>
        <translation>Der Fall wird ohne seinen letzten Bohrzug gezeigt, der in ihm bleibt.</translation>
    </message>
    <message>
        <source>The case is shown without its last %1 strokes, which stay in it.</source>
        <translation>Der Fall wird ohne seine letzten %1 Bohrzüge gezeigt, die in ihm bleiben.</translation>
    </message>
    <message>
        <source>Open a DICOM folder</source>
        <translation>DICOM-Ordner öffnen</translation>
    </message>
    <message>
        <source>Open a DICOM folder, and choose a region</source>
        <translation>DICOM-Ordner öffnen und einen Ausschnitt wählen</translation>
    </message>
    <message>
        <source>Open an image file, and choose a region of it</source>
        <translation>Bilddatei öffnen und einen Ausschnitt davon wählen</translation>
    </message>
    <message>
        <source>Images (%1);;All files (*)</source>
        <translation>Bilder (%1);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Add an MR from a DICOM folder</source>
        <translation>MR aus einem DICOM-Ordner hinzufügen</translation>
    </message>
    <message>
        <source>Add structures from a folder of masks</source>
        <translation>Strukturen aus einem Ordner von Masken hinzufügen</translation>
    </message>
    <message>
        <source>Meshes</source>
        <translation>Netze</translation>
    </message>
    <message>
        <source>Segmentations and label maps</source>
        <translation>Segmentierungen und Label-Karten</translation>
    </message>
    <message>
        <source>MR images</source>
        <translation>MR-Bilder</translation>
    </message>
    <message>
        <source>Add to “%1”</source>
        <translation>Zu „%1“ hinzufügen</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Open images, labels or meshes</source>
        <translation>Bilder, Labels oder Netze öffnen</translation>
    </message>
    <message>
        <source>Images, labels, meshes (%1);;All files (*)</source>
        <translation>Bilder, Labels, Netze (%1);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>The case is not saved yet, so nothing was exported</source>
        <translation>Der Fall ist noch nicht gespeichert, daher wurde nichts exportiert</translation>
    </message>
    <message>
        <source>Exporting from %1</source>
        <translation>Export aus %1</translation>
    </message>
    <message>
        <source>Written: %1%2</source>
        <translation>Geschrieben: %1%2</translation>
    </message>
    <message>
        <source>
Volume of the voxels: %1 mm³</source>
        <translation>
Volumen der Voxel: %1 mm³</translation>
    </message>
    <message>
        <source>
Coordinates: %1</source>
        <translation>
Koordinaten: %1</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>Exportieren</translation>
    </message>
    <message>
        <source>On the %1&apos;s grid each of its voxels takes the nearest label, so that volumes change by the voxels at the border.</source>
        <translation>Auf dem Gitter des %1 nimmt jedes Voxel das nächste Label, sodass sich Volumina um die Voxel am Rand ändern.</translation>
    </message>
    <message>
        <source>Export on the %1&apos;s &amp;grid</source>
        <translation>Auf dem &amp;Gitter des %1 exportieren</translation>
    </message>
    <message>
        <source>The case is not saved yet, so it was not archived</source>
        <translation>Der Fall ist noch nicht gespeichert, daher wurde er nicht archiviert</translation>
    </message>
    <message>
        <source>Archiving %1</source>
        <translation>%1 wird archiviert</translation>
    </message>
    <message>
        <source>The plan of “%1” is archived.</source>
        <translation>Der Plan von „%1“ ist archiviert.</translation>
    </message>
    <message>
        <source>“%1” is archived.</source>
        <translation>„%1“ ist archiviert.</translation>
    </message>
    <message>
        <source>
File: %1, %2
In it: %3</source>
        <translation>
Datei: %1, %2
Darin: %3</translation>
    </message>
    <message>
        <source>
The disk reported an error; check the disk.</source>
        <translation>
Die Platte meldete einen Fehler; prüfen Sie die Platte.</translation>
    </message>
    <message>
        <source>Restore a case from its archive</source>
        <translation>Fall aus seinem Archiv wiederherstellen</translation>
    </message>
    <message>
        <source>Case archives (*%1);;All files (*)</source>
        <translation>Archive von Fällen (*%1);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Restoring %1</source>
        <translation>%1 wird wiederhergestellt</translation>
    </message>
    <message>
        <source>Restore</source>
        <translation>Wiederherstellen</translation>
    </message>
    <message>
        <source>The library has a case “%1”. Name of the restored one:</source>
        <translation>Die Bibliothek hat einen Fall „%1“. Name des wiederhergestellten:</translation>
    </message>
    <message>
        <source>No temporary folder can be made: %1</source>
        <translation>Es lässt sich kein temporärer Ordner anlegen: %1</translation>
    </message>
    <message>
        <source>Save as</source>
        <translation>Speichern unter</translation>
    </message>
    <message>
        <source>Name of the new case:</source>
        <translation>Name des neuen Falls:</translation>
    </message>
    <message>
        <source>They must be of the same patient.%1</source>
        <translation>Sie müssen von demselben Patienten sein.%1</translation>
    </message>
    <message>
        <source>Those of the case stay as they are.</source>
        <translation>Die des Falls bleiben, wie sie sind.</translation>
    </message>
    <message>
        <source>1 other structure of the file is new to the case.</source>
        <translation>1 andere Struktur der Datei ist neu für den Fall.</translation>
    </message>
    <message>
        <source>%1 other structures of the file are new to the case.</source>
        <translation>%1 andere Strukturen der Datei sind neu für den Fall.</translation>
    </message>
    <message>
        <source>The case has “%1” already, which is in “%2”, too. What is it to be called?</source>
        <translation>Der Fall hat bereits „%1“, das auch in „%2“ steht. Wie soll es heißen?</translation>
    </message>
    <message>
        <source>The case has parts of %1 of the names in “%2” already. What are they to be called?</source>
        <translation>Der Fall hat bereits Teile mit %1 der Namen in „%2“. Wie sollen sie heißen?</translation>
    </message>
    <message>
        <source>&amp;Add under this name</source>
        <translation>Unter diesem Namen &amp;hinzufügen</translation>
    </message>
    <message>
        <source>&amp;Add under these names</source>
        <translation>Unter diesen Namen &amp;hinzufügen</translation>
    </message>
    <message>
        <source>Put the slices of one acquisition of one patient alone into a folder, and open that.</source>
        <translation>Legen Sie die Schichten einer einzigen Aufnahme eines einzigen Patienten allein in einen Ordner, und öffnen Sie diesen.</translation>
    </message>
    <message>
        <source>Ask for the original thin slices, or open another series of the patient.</source>
        <translation>Fragen Sie nach den dünnen Originalschichten, oder öffnen Sie eine andere Serie des Patienten.</translation>
    </message>
    <message>
        <source>The scan cannot be used</source>
        <translation>Die Aufnahme ist nicht verwendbar</translation>
    </message>
    <message>
        <source>“%1” cannot be used: it would mislead.</source>
        <translation>„%1“ ist nicht verwendbar: Die Aufnahme würde irreführen.</translation>
    </message>
    <message>
        <source>Open &amp;another…</source>
        <translation>&amp;Anderes öffnen…</translation>
    </message>
    <message>
        <source>Not added: “%1”</source>
        <translation>Nicht hinzugefügt: „%1“</translation>
    </message>
    <message>
        <source>Copy or send the series again, with all of its slices: Library &gt; Receive fetches it from the archive. Anatomy that is missing is not made up.</source>
        <translation>Kopieren oder senden Sie die Serie noch einmal, mit allen Schichten: Bibliothek &gt; Empfangen holt sie aus dem Archiv. Fehlende Anatomie wird nicht erfunden.</translation>
    </message>
    <message>
        <source>Another place?</source>
        <translation>Ein anderer Ort?</translation>
    </message>
    <message>
        <source>They may be another patient&apos;s, or of another scan.</source>
        <translation>Sie gehören vielleicht zu einem anderen Patienten oder zu einer anderen Aufnahme.</translation>
    </message>
    <message>
        <source>Do &amp;not add</source>
        <translation>&amp;Nicht hinzufügen</translation>
    </message>
    <message>
        <source>&amp;Add anyway</source>
        <translation>Trotzdem &amp;hinzufügen</translation>
    </message>
    <message>
        <source>Add the &amp;others only</source>
        <translation>Nur die &amp;anderen hinzufügen</translation>
    </message>
    <message>
        <source>&amp;Add all</source>
        <translation>A&amp;lle hinzufügen</translation>
    </message>
    <message>
        <source>How large is it?</source>
        <translation>Wie groß ist es?</translation>
    </message>
    <message>
        <source>By the unit of length that “%1” states, it is %2 mm long: no head, ear or specimen.</source>
        <translation>Nach der Längeneinheit, die „%1“ nennt, ist es %2 mm lang: kein Kopf, Ohr oder Präparat.</translation>
    </message>
    <message>
        <source>“%1” states no unit of length, and in millimetres it is %2 mm long: no head, ear or specimen.</source>
        <translation>„%1“ nennt keine Längeneinheit und ist in Millimetern %2 mm lang: kein Kopf, Ohr oder Präparat.</translation>
    </message>
    <message>
        <source>In which unit are its numbers? Every distance, tool and thickness follows this answer. Export the file again with its unit if you do not know it.</source>
        <translation>In welcher Einheit sind die Zahlen? Alle Abstände, Werkzeuge und Dicken richten sich nach dieser Antwort. Exportieren Sie die Datei mit ihrer Einheit neu, wenn Sie es nicht wissen.</translation>
    </message>
    <message>
        <source>In %1: %2 mm long</source>
        <translation>In %1: %2 mm lang</translation>
    </message>
    <message>
        <source>What are these bits?</source>
        <translation>Was sind diese Bits?</translation>
    </message>
    <message>
        <source>The scan contradicts itself about the bits of a pixel.</source>
        <translation>Die Aufnahme widerspricht sich bei den Bits eines Pixels.</translation>
    </message>
    <message>
        <source>A wrong answer shows metal as tissue, or tissue as metal, where these pixels are. Answer only if the values tell; otherwise export the scan again.</source>
        <translation>Eine falsche Antwort zeigt an diesen Pixeln Metall als Gewebe oder Gewebe als Metall. Antworten Sie nur, wenn die Werte es verraten; exportieren Sie die Aufnahme sonst neu.</translation>
    </message>
    <message>
        <source>&amp;Leave the bits out</source>
        <translation>Bits &amp;weglassen</translation>
    </message>
    <message>
        <source>&amp;Keep the bits</source>
        <translation>Bits &amp;behalten</translation>
    </message>
    <message>
        <source>In %1, as the file says: %2 mm long</source>
        <translation>In %1, wie die Datei sagt: %2 mm lang</translation>
    </message>
    <message>
        <source>and %1 undone</source>
        <translation>und %1 zurückgenommen</translation>
    </message>
    <message>
        <source>and %1 of other approaches</source>
        <translation>und %1 in anderen Zugängen</translation>
    </message>
    <message>
        <source>“%1”</source>
        <translation>„%1“</translation>
    </message>
    <message>
        <source>The case is called “%1”: the name of its folder was not taken, as it may be the patient&apos;s; F2 in the library, or Save as…, gives it another one</source>
        <translation>Der Fall heißt „%1“: Der Name seines Ordners wurde nicht übernommen, da er der des Patienten sein kann; F2 in der Bibliothek oder Speichern unter… gibt ihm einen anderen</translation>
    </message>
    <message>
        <source>Not added: %1</source>
        <translation>Nicht hinzugefügt: %1</translation>
    </message>
    <message>
        <source>The structure of %1 lies outside the image of this case: nothing of it will be seen or felt.</source>
        <translation>Die Struktur aus %1 liegt außerhalb des Bildes dieses Falls: Nichts von ihr wird zu sehen oder zu fühlen sein.</translation>
    </message>
    <message>
        <source>None of the %2 structures of %1 lies in the image of this case: nothing of them will be seen or felt.</source>
        <translation>Keine der %2 Strukturen aus %1 liegt im Bild dieses Falls: Nichts von ihnen wird zu sehen oder zu fühlen sein.</translation>
    </message>
    <message>
        <source>1 of the %2 structures of %1 lies outside the image of this case: nothing of it will be seen or felt.</source>
        <translation>1 der %2 Strukturen aus %1 liegt außerhalb des Bildes dieses Falls: Nichts von ihr wird zu sehen oder zu fühlen sein.</translation>
    </message>
    <message>
        <source>%3 of the %2 structures of %1 lie outside the image of this case: nothing of them will be seen or felt.</source>
        <translation>%3 der %2 Strukturen aus %1 liegen außerhalb des Bildes dieses Falls: Nichts von ihnen wird zu sehen oder zu fühlen sein.</translation>
    </message>
    <message>
        <source>“%1” states another patient than the images of “%2” do. What differs: %3.</source>
        <translation>„%1“ nennt einen anderen Patienten als die Bilder von „%2“. Es unterscheiden sich: %3.</translation>
    </message>
    <message>
        <source> An MR is shown over the %1 once it is registered.</source>
        <translation> Ein MR wird über dem %1 gezeigt, sobald es registriert ist.</translation>
    </message>
    <message>
        <source>Bring back</source>
        <translation>Zurückholen</translation>
    </message>
    <message>
        <source>Save under another name…</source>
        <translation>Unter anderem Namen speichern…</translation>
    </message>
    <message>
        <source>Not saved: another program deleted the case “%1”. Bring it back, or save it under another name. The work is still open in this window.</source>
        <translation>Nicht gespeichert: Ein anderes Programm hat den Fall „%1“ gelöscht. Holen Sie ihn zurück, oder speichern Sie ihn unter einem anderen Namen. Die Arbeit ist in diesem Fenster noch offen.</translation>
    </message>
    <message>
        <source>Bringing back %1</source>
        <translation>%1 wird zurückgeholt</translation>
    </message>
    <message>
        <source>Does it lie where it belongs?</source>
        <translation>Liegt sie, wo sie hingehört?</translation>
    </message>
    <message>
        <source>“%1” has another grid than the CT, which was repaired.</source>
        <translation>„%1“ hat ein anderes Gitter als das CT, das repariert wurde.</translation>
    </message>
    <message>
        <source>Drawn on the slices as they lie in the files, by a program that takes them for straight and even, it lies up to %1 mm off the bone. How each slice was moved is not known of it, so that it cannot follow the repair: export the repaired CT and draw it there. What was drawn on the repaired CT, or where each slice really lies, fits.</source>
        <translation>Wurde sie auf den Schichten gezeichnet, wie sie in den Dateien liegen, von einem Programm, das sie für gerade und gleichmäßig hält, so liegt sie bis zu %1 mm neben dem Knochen. Wie jede Schicht bewegt wurde, ist nicht bekannt, daher kann sie der Reparatur nicht folgen: Exportieren Sie das reparierte CT und zeichnen Sie darauf. Was auf dem reparierten CT gezeichnet wurde, oder wo jede Schicht wirklich liegt, passt.</translation>
    </message>
    <message>
        <source>&amp;Add it as it lies</source>
        <translation>So &amp;hinzufügen, wie sie liegt</translation>
    </message>
    <message>
        <source>“%1” does not tell in which space of an image of this case it lies.</source>
        <translation>„%1“ sagt nicht, in welchem Raum eines Bildes dieses Falls es liegt.</translation>
    </message>
    <message>
        <source>The axes of an image were corrected. What was drawn on it as its file states it follows the correction; what lies where it belongs already, such as an export of this case, stays.</source>
        <translation>Die Achsen eines Bildes wurden korrigiert. Was darauf gezeichnet wurde, wie die Datei es angibt, folgt der Korrektur; was schon richtig liegt, etwa ein Export dieses Falls, bleibt.</translation>
    </message>
    <message>
        <source>&amp;Leave it where it is</source>
        <translation>&amp;Lassen, wo es ist</translation>
    </message>
    <message>
        <source>%1 (axes corrected)</source>
        <translation>%1 (Achsen korrigiert)</translation>
    </message>
    <message>
        <source>The case is closed, and “%1” is opened,</source>
        <translation>Der Fall wird geschlossen und „%1“ geöffnet</translation>
    </message>
    <message>
        <source>The case is closed</source>
        <translation>Der Fall wird geschlossen</translation>
    </message>
    <message>
        <source>Petrous is closed</source>
        <translation>Petrous wird beendet</translation>
    </message>
    <message>
        <source>The axes of “%1” are corrected</source>
        <translation>Die Achsen von „%1“ sind korrigiert</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::CaseJobs</name>
    <message>
        <source>Still running</source>
        <translation>Läuft noch</translation>
    </message>
    <message>
        <source>Still running: %1</source>
        <translation>Läuft noch: %1</translation>
    </message>
    <message>
        <source>What is stopped now is lost, and the case stays as it was before.</source>
        <translation>Was jetzt beendet wird, ist verloren, und der Fall bleibt, wie er vorher war.</translation>
    </message>
    <message>
        <source>&amp;Wait for it</source>
        <translation>&amp;Abwarten</translation>
    </message>
    <message>
        <source>Goes on with this as soon as it is done; you can work meanwhile</source>
        <translation>Fährt damit fort, sobald es fertig ist; Sie können inzwischen weiterarbeiten</translation>
    </message>
    <message>
        <source>&amp;Stop it</source>
        <translation>&amp;Beenden</translation>
    </message>
    <message>
        <source>Without its result</source>
        <translation>Ohne das Ergebnis</translation>
    </message>
    <message>
        <source>&amp;Go on working</source>
        <translation>&amp;Weiterarbeiten</translation>
    </message>
    <message>
        <source>It goes on running, and the case stays open</source>
        <translation>Es läuft weiter, und der Fall bleibt offen</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::CaseSaver</name>
    <message>
        <source>The save was stopped.</source>
        <translation>Das Speichern wurde angehalten.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::CaseStamps</name>
    <message>
        <source>side not stated</source>
        <translation>Seite nicht angegeben</translation>
    </message>
    <message>
        <source>planned %1</source>
        <translation>geplant %1</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>Links</translation>
    </message>
    <message>
        <source>Right</source>
        <translation>Rechts</translation>
    </message>
    <message>
        <source>Both</source>
        <translation>Beide</translation>
    </message>
    <message>
        <source>Later</source>
        <translation>Später</translation>
    </message>
    <message>
        <source>Which side of the patient is operated on? It stands over every view and is kept with the case (Case &gt; Side).</source>
        <translation>Welche Seite des Patienten wird operiert? Sie steht über jeder Ansicht und bleibt beim Fall (Fall &gt; Seite).</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::CasesModel</name>
    <message>
        <source>planned %1</source>
        <translation>geplant %1</translation>
    </message>
    <message>
        <source>damaged</source>
        <translation>beschädigt</translation>
    </message>
    <message>
        <source>%1: its file cannot be read. It can still be renamed and deleted; Library &gt; Verify says what is wrong.</source>
        <translation>%1: Die Datei ist nicht lesbar. Der Fall kann noch umbenannt und gelöscht werden; Bibliothek &gt; Prüfen sagt, was falsch ist.</translation>
    </message>
    <message>
        <source> (open)</source>
        <translation> (offen)</translation>
    </message>
    <message>
        <source>changed %1</source>
        <translation>geändert %1</translation>
    </message>
    <message>
        <source>%1 voxels, %2 structures</source>
        <translation>%1 Voxel, %2 Strukturen</translation>
    </message>
    <message>
        <source>%1 strokes, %2 mm³ removed</source>
        <translation>%1 Bohrzüge, %2 mm³ abgetragen</translation>
    </message>
    <message>
        <source>with a note</source>
        <translation>mit einer Notiz</translation>
    </message>
    <message>
        <source>Case</source>
        <translation>Fall</translation>
    </message>
    <message>
        <source>Changed</source>
        <translation>Geändert</translation>
    </message>
    <message>
        <source>Diagnosis</source>
        <translation>Diagnose</translation>
    </message>
    <message>
        <source>Side</source>
        <translation>Seite</translation>
    </message>
    <message>
        <source>Planned</source>
        <translation>Geplant</translation>
    </message>
    <message>
        <source>Tags</source>
        <translation>Schlagwörter</translation>
    </message>
    <message>
        <source>Structures</source>
        <translation>Strukturen</translation>
    </message>
    <message>
        <source>Strokes</source>
        <translation>Bohrzüge</translation>
    </message>
    <message>
        <source>Removed mm³</source>
        <translation>Abgetragen mm³</translation>
    </message>
    <message>
        <source>Voxels</source>
        <translation>Voxel</translation>
    </message>
    <message>
        <source>newer version</source>
        <translation>neuere Version</translation>
    </message>
    <message>
        <source>%1: was written by a newer version of Petrous; open it with that one. Here it is left alone.</source>
        <translation>%1: wurde von einer neueren Version von Petrous geschrieben; öffnen Sie den Fall mit dieser. Hier bleibt er unberührt.</translation>
    </message>
    <message>
        <source>1 stroke, %1 mm³ removed</source>
        <translation>1 Bohrzug, %1 mm³ abgetragen</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::CatalogueDialog</name>
    <message>
        <source>Materials</source>
        <translation>Materialien</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Shown as</source>
        <translation>Angezeigt als</translation>
    </message>
    <message>
        <source>Cutting energy, GPa</source>
        <translation>Schnittenergie, GPa</translation>
    </message>
    <message>
        <source>Friction</source>
        <translation>Reibung</translation>
    </message>
    <message>
        <source>Hardness, HV</source>
        <translation>Härte, HV</translation>
    </message>
    <message>
        <source>Burrs</source>
        <translation>Fräsen</translation>
    </message>
    <message>
        <source>Rake, °</source>
        <translation>Spanwinkel, °</translation>
    </message>
    <message>
        <source>Wear coefficient</source>
        <translation>Verschleißbeiwert</translation>
    </message>
    <message>
        <source>Diameters, mm</source>
        <translation>Durchmesser, mm</translation>
    </message>
    <message>
        <source>Materials and burrs</source>
        <translation>Materialien und Fräsen</translation>
    </message>
    <message>
        <source>They hold for all cases of this library, also for the command. The removal laws take the cutting energy and friction for a cutting burr, the hardness for a diamond one.</source>
        <translation>Sie gelten für alle Fälle dieser Bibliothek, auch für den Befehl. Die Abtragsgesetze nehmen bei einer schneidenden Fräse Schnittenergie und Reibung, bei einer Diamantfräse die Härte.</translation>
    </message>
    <message>
        <source>&amp;Add</source>
        <translation>&amp;Hinzufügen</translation>
    </message>
    <message>
        <source>&amp;Remove</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>Takes the selected material out</source>
        <translation>Nimmt das ausgewählte Material heraus</translation>
    </message>
    <message>
        <source>As &amp;built in</source>
        <translation>Wie &amp;mitgeliefert</translation>
    </message>
    <message>
        <source>All numbers as they come with the program</source>
        <translation>Alle Zahlen, wie sie mit dem Programm kommen</translation>
    </message>
    <message>
        <source>&amp;Save</source>
        <translation>&amp;Speichern</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Bone that nobody labelled goes from “%1” at %2 HU to “%3” at %4 HU.</source>
        <translation>Knochen, den niemand segmentiert hat, geht von „%1“ bei %2 HU bis „%3“ bei %4 HU.</translation>
    </message>
    <message>
        <source>Cutting</source>
        <translation>Schneidend</translation>
    </message>
    <message>
        <source>Diamond</source>
        <translation>Diamant</translation>
    </message>
    <message>
        <source>Other cases that use “%1” cannot be drilled until it exists again.</source>
        <translation>Andere Fälle, die „%1“ verwenden, können erst wieder gebohrt werden, wenn es das Material wieder gibt.</translation>
    </message>
    <message>
        <source>“%1”, %2</source>
        <translation>„%1“, %2</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>A&amp;dd</source>
        <translation>Hinzu&amp;fügen</translation>
    </message>
    <message>
        <source>R&amp;emove</source>
        <translation>Entfer&amp;nen</translation>
    </message>
    <message>
        <source>Takes the selected burr out. Strokes and recordings keep its name</source>
        <translation>Entfernt die ausgewählte Fräse. Bohrzüge und Aufzeichnungen behalten ihren Namen</translation>
    </message>
    <message>
        <source>Cases with the burr “%1” get the usual one of its kind until it exists again.</source>
        <translation>Fälle mit der Fräse „%1“ bekommen die übliche ihrer Art, bis es sie wieder gibt.</translation>
    </message>
    <message>
        <source>not stated</source>
        <translation>nicht angegeben</translation>
    </message>
    <message>
        <source>Another material, with the numbers of the one that is selected. Their source is not stated until you enter it</source>
        <translation>Ein weiteres Material mit den Zahlen des ausgewählten. Ihre Quelle ist nicht angegeben, bis Sie sie eingeben</translation>
    </message>
    <message>
        <source>Another burr, of the kind and with the numbers of the one that is selected. Their source is not stated until you enter it</source>
        <translation>Eine weitere Fräse von der Art und mit den Zahlen der ausgewählten. Ihre Quelle ist nicht angegeben, bis Sie sie eingeben</translation>
    </message>
    <message>
        <source>How certain</source>
        <translation>Wie sicher</translation>
    </message>
    <message>
        <source>Source</source>
        <translation>Quelle</translation>
    </message>
    <message>
        <source>Grit, µm</source>
        <translation>Körnung, µm</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ClippingController</name>
    <message>
        <source>Nothing is cut away by a plane</source>
        <translation>Keine Ebene schneidet etwas weg</translation>
    </message>
    <message>
        <source>Open a case first</source>
        <translation>Öffnen Sie zuerst einen Fall</translation>
    </message>
    <message>
        <source>The crop box comes when the tool is put away</source>
        <translation>Der Beschnittquader erscheint, sobald das Werkzeug weggelegt ist</translation>
    </message>
    <message>
        <source>Crop box: %1</source>
        <translation>Beschnittquader: %1</translation>
    </message>
    <message>
        <source>Turn the patient: this face is dragged along the line of sight</source>
        <translation>Drehen Sie den Patienten: Diese Fläche wird entlang der Blickrichtung gezogen</translation>
    </message>
    <message>
        <source>Turn the patient: the plane is dragged along the line of sight</source>
        <translation>Drehen Sie den Patienten: Die Ebene wird entlang der Blickrichtung gezogen</translation>
    </message>
    <message>
        <source>%1 = %2 mm, width %3 mm</source>
        <translation>%1 = %2 mm, Breite %3 mm</translation>
    </message>
    <message>
        <source>middle at x = %1, y = %2, z = %3 mm</source>
        <translation>Mitte bei x = %1, y = %2, z = %3 mm</translation>
    </message>
    <message>
        <source>moved by %1 mm</source>
        <translation>um %1 mm verschoben</translation>
    </message>
    <message>
        <source>%1 mm before the bone&apos;s surface, moved by %2 mm</source>
        <translation>%1 mm vor der Knochenoberfläche, um %2 mm verschoben</translation>
    </message>
    <message>
        <source>%1 mm behind the bone&apos;s surface, moved by %2 mm</source>
        <translation>%1 mm hinter der Knochenoberfläche, um %2 mm verschoben</translation>
    </message>
    <message>
        <source>The plane does not cut this slice: it is turned in another</source>
        <translation>Die Ebene schneidet diese Schicht nicht: Gedreht wird sie in einer anderen</translation>
    </message>
    <message>
        <source>turned by %1°</source>
        <translation>um %1° gedreht</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ColorChooser</name>
    <message>
        <source>Colours</source>
        <translation>Farben</translation>
    </message>
    <message>
        <source>More colours…</source>
        <translation>Weitere Farben…</translation>
    </message>
    <message>
        <source>Any colour, also by its numbers</source>
        <translation>Beliebige Farbe, auch über ihre Zahlen</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::CommandPalette</name>
    <message>
        <source>Find a command</source>
        <translation>Befehl suchen</translation>
    </message>
    <message>
        <source>Type what it is called, or what it does</source>
        <translation>Tippen Sie, wie er heißt oder was er tut</translation>
    </message>
    <message>
        <source>Search commands</source>
        <translation>Befehle durchsuchen</translation>
    </message>
    <message>
        <source>Commands</source>
        <translation>Befehle</translation>
    </message>
    <message>
        <source>Command</source>
        <translation>Befehl</translation>
    </message>
    <message>
        <source>Menu or panel</source>
        <translation>Menü oder Bereich</translation>
    </message>
    <message>
        <source>Key</source>
        <translation>Taste</translation>
    </message>
    <message>
        <source>not available now. %1</source>
        <translation>jetzt nicht verfügbar. %1</translation>
    </message>
    <message>
        <source>No command is called so.</source>
        <translation>Kein Befehl heißt so.</translation>
    </message>
    <message>
        <source>Not available now.</source>
        <translation>Jetzt nicht verfügbar.</translation>
    </message>
    <message>
        <source>Not available now: %1</source>
        <translation>Jetzt nicht verfügbar: %1</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ComparisonWindow</name>
    <message>
        <source>%1 ± %2 mm</source>
        <translation>%1 ± %2 mm</translation>
    </message>
    <message>
        <source>reached (± %1 mm)</source>
        <translation>erreicht (± %1 mm)</translation>
    </message>
    <message>
        <source>&amp;Difference in colours</source>
        <translation>&amp;Unterschied in Farben</translation>
    </message>
    <message>
        <source>Approaches compared — Petrous</source>
        <translation>Zugänge im Vergleich — Petrous</translation>
    </message>
    <message>
        <source>First approach</source>
        <translation>Erster Zugang</translation>
    </message>
    <message>
        <source>Second approach</source>
        <translation>Zweiter Zugang</translation>
    </message>
    <message>
        <source>What one of them removed, or both, in colours: here in one picture, and in the slices</source>
        <translation>Was einer von ihnen oder beide abgetragen haben, in Farben: hier in einem Bild und in den Schichten</translation>
    </message>
    <message>
        <source>Comparing, %p %</source>
        <translation>Vergleich, %p %</translation>
    </message>
    <message>
        <source>The approaches in numbers</source>
        <translation>Die Zugänge in Zahlen</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>only %1</source>
        <translation>nur %1</translation>
    </message>
    <message>
        <source>both</source>
        <translation>beide</translation>
    </message>
    <message>
        <source>Strokes, %1 in common</source>
        <translation>Bohrzüge, %1 gemeinsam</translation>
    </message>
    <message>
        <source>Drilling time</source>
        <translation>Bohrzeit</translation>
    </message>
    <message>
        <source>Removed</source>
        <translation>Abgetragen</translation>
    </message>
    <message>
        <source>Removed there alone</source>
        <translation>Nur dort abgetragen</translation>
    </message>
    <message>
        <source>Removed in both</source>
        <translation>In beiden abgetragen</translation>
    </message>
    <message>
        <source>Removed of %1</source>
        <translation>Von %1 abgetragen</translation>
    </message>
    <message>
        <source>mm³</source>
        <translation>mm³</translation>
    </message>
    <message>
        <source>Exposed of %1</source>
        <translation>Von %1 freigelegt</translation>
    </message>
    <message>
        <source>mm²</source>
        <translation>mm²</translation>
    </message>
    <message>
        <source>Distance to %1</source>
        <translation>Abstand zu %1</translation>
    </message>
    <message>
        <source>From the walls of what was removed to the structure&apos;s surface</source>
        <translation>Von den Wänden des Abgetragenen zur Oberfläche der Struktur</translation>
    </message>
    <message>
        <source>%1 mm, uncertainty unknown</source>
        <translation>%1 mm, Unsicherheit unbekannt</translation>
    </message>
    <message>
        <source>reached, uncertainty unknown</source>
        <translation>erreicht, Unsicherheit unbekannt</translation>
    </message>
    <message>
        <source>&amp;Compare again</source>
        <translation>&amp;Noch einmal vergleichen</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Compares the two approaches once more</source>
        <translation>Vergleicht die beiden Zugänge noch einmal</translation>
    </message>
    <message>
        <source>Stops comparing; the approaches stay as they are</source>
        <translation>Hält den Vergleich an; die Zugänge bleiben, wie sie sind</translation>
    </message>
    <message>
        <source>Quantity</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Comparing was stopped.</source>
        <translation>Der Vergleich wurde angehalten.</translation>
    </message>
    <message>
        <source>Comparing; the picture comes after that</source>
        <translation>Wird verglichen; danach kommt das Bild</translation>
    </message>
    <message>
        <source>Not compared</source>
        <translation>Nicht verglichen</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::CropBoxDialog</name>
    <message>
        <source>Crop box</source>
        <translation>Beschnittquader</translation>
    </message>
    <message>
        <source>&amp;Whole image</source>
        <translation>&amp;Ganzes Bild</translation>
    </message>
    <message>
        <source>All of the image is shown again; clipping planes stay</source>
        <translation>Zeigt wieder das ganze Bild; Schnittebenen bleiben</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::DecimalPoint</name>
    <message>
        <source>From %1 to %2%3</source>
        <translation>Von %1 bis %2%3</translation>
    </message>
    <message>
        <source>%1, whole numbers</source>
        <translation>%1, ganze Zahlen</translation>
    </message>
    <message>
        <source>%1, decimals: at most %2</source>
        <translation>%1, Nachkommastellen: höchstens %2</translation>
    </message>
    <message>
        <source>“%1” is not possible here; the number is as it was. %2.</source>
        <translation>„%1“ ist hier nicht möglich; die Zahl ist wie zuvor. %2.</translation>
    </message>
    <message>
        <source>%1 is above the most, %2</source>
        <translation>%1 liegt über dem Höchstwert %2</translation>
    </message>
    <message>
        <source>%1 is below the least, %2</source>
        <translation>%1 liegt unter dem Mindestwert %2</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::DeidentifyDialog</name>
    <message>
        <source>Folder of DICOM files</source>
        <translation>Ordner von DICOM-Dateien</translation>
    </message>
    <message>
        <source>New or empty folder</source>
        <translation>Neuer oder leerer Ordner</translation>
    </message>
    <message>
        <source>Descriptions, &amp;reduced to medical words</source>
        <translation>Beschreibungen, auf medizinische Wörter be&amp;schränkt</translation>
    </message>
    <message>
        <source>Otherwise descriptions are removed</source>
        <translation>Sonst werden Beschreibungen entfernt</translation>
    </message>
    <message>
        <source>What identifies the de&amp;vice</source>
        <translation>Was das &amp;Gerät kennzeichnet</translation>
    </message>
    <message>
        <source>Model, software, names of sequences, kernels and coils</source>
        <translation>Modell, Software, Namen von Sequenzen, Kernen und Spulen</translation>
    </message>
    <message>
        <source>Se&amp;x, age, size and weight</source>
        <translation>Geschlecht, &amp;Alter, Größe und Gewicht</translation>
    </message>
    <message>
        <source>Private attributes that the &amp;standard lists as safe</source>
        <translation>Private Attribute, die der Standard als sicher &amp;führt</translation>
    </message>
    <message>
        <source>PS3.15, Table E.3.10-1</source>
        <translation>PS3.15, Tabelle E.3.10-1</translation>
    </message>
    <message>
        <source>Images that may &amp;have text in their pixels</source>
        <translation>Bilder, die Te&amp;xt in ihren Pixeln haben können</translation>
    </message>
    <message>
        <source>Otherwise they are left out, and named</source>
        <translation>Sonst werden sie ausgelassen und genannt</translation>
    </message>
    <message>
        <source>Put &amp;air in place of the face in CT and MR series</source>
        <translation>Das Gesicht in CT- und MR-Serien durch &amp;Luft ersetzen</translation>
    </message>
    <message>
        <source>In front of a plane about 50 mm behind the tip of the nose. Images that are in no such volume are left out, and named</source>
        <translation>Vor einer Ebene etwa 50 mm hinter der Nasenspitze. Bilder, die in keinem solchen Volumen sind, werden ausgelassen und genannt</translation>
    </message>
    <message>
        <source>Remember who is &amp;behind the pseudonyms</source>
        <translation>Merken, wer &amp;hinter den Pseudonymen steht</translation>
    </message>
    <message>
        <source>In an encrypted file that stays here. The same file gives the same pseudonyms, UIDs and date shifts again</source>
        <translation>In einer verschlüsselten Datei, die hier bleibt. Dieselbe Datei ergibt wieder dieselben Pseudonyme, UIDs und Datumsverschiebungen</translation>
    </message>
    <message>
        <source>File of the pseudonyms</source>
        <translation>Datei der Pseudonyme</translation>
    </message>
    <message>
        <source>De-identify DICOM files</source>
        <translation>DICOM-Dateien de-identifizieren</translation>
    </message>
    <message>
        <source>removed</source>
        <translation>entfernt</translation>
    </message>
    <message>
        <source>shifted, by days of each patient&apos;s own</source>
        <translation>verschoben, um eigene Tage je Patient</translation>
    </message>
    <message>
        <source>kept</source>
        <translation>behalten</translation>
    </message>
    <message>
        <source>&amp;From:</source>
        <translation>&amp;Von:</translation>
    </message>
    <message>
        <source>&amp;To:</source>
        <translation>&amp;Nach:</translation>
    </message>
    <message>
        <source>&amp;Dates:</source>
        <translation>&amp;Daten:</translation>
    </message>
    <message>
        <source>Keep:</source>
        <translation>Behalten:</translation>
    </message>
    <message>
        <source>Face:</source>
        <translation>Gesicht:</translation>
    </message>
    <message>
        <source>Fi&amp;le:</source>
        <translation>Da&amp;tei:</translation>
    </message>
    <message>
        <source>&amp;Passphrase:</source>
        <translation>&amp;Passphrase:</translation>
    </message>
    <message>
        <source>Once &amp;more:</source>
        <translation>N&amp;och einmal:</translation>
    </message>
    <message>
        <source>De-&amp;identify</source>
        <translation>De-&amp;identifizieren</translation>
    </message>
    <message>
        <source>Choose the folder whose files are to be de-identified; it is never changed.</source>
        <translation>Wählen Sie den Ordner, dessen Dateien de-identifiziert werden sollen; er wird nie geändert.</translation>
    </message>
    <message>
        <source>Choose a new or empty folder for what is written.</source>
        <translation>Wählen Sie einen neuen oder leeren Ordner für das, was geschrieben wird.</translation>
    </message>
    <message>
        <source>Choose the file of the pseudonyms; it need not exist yet.</source>
        <translation>Wählen Sie die Datei der Pseudonyme; es muss sie noch nicht geben.</translation>
    </message>
    <message>
        <source>The file is new: type the same passphrase once more. Who forgets it cannot find out any more who is who.</source>
        <translation>Die Datei ist neu: Tippen Sie dieselbe Passphrase noch einmal. Wer sie vergisst, kann nicht mehr herausfinden, wer wer ist.</translation>
    </message>
    <message>
        <source>By PS3.15, Basic Application Level Confidentiality Profile. What stays and why is listed at the end.</source>
        <translation>Nach PS3.15, Basic Application Level Confidentiality Profile. Was bleibt und warum, steht am Ende.</translation>
    </message>
    <message>
        <source>The passphrase must have at least %1 characters.</source>
        <translation>Die Passphrase muss mindestens %1 Zeichen haben.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::DescriptionDialog</name>
    <message>
        <source>left</source>
        <translation>links</translation>
    </message>
    <message>
        <source>right</source>
        <translation>rechts</translation>
    </message>
    <message>
        <source>both</source>
        <translation>beide</translation>
    </message>
    <message>
        <source>Describe “%1”</source>
        <translation>„%1“ beschreiben</translation>
    </message>
    <message>
        <source>not stated</source>
        <translation>nicht angegeben</translation>
    </message>
    <message>
        <source>separated by commas</source>
        <translation>durch Kommas getrennt</translation>
    </message>
    <message>
        <source>&amp;Diagnosis:</source>
        <translation>&amp;Diagnose:</translation>
    </message>
    <message>
        <source>&amp;Procedure:</source>
        <translation>&amp;Eingriff:</translation>
    </message>
    <message>
        <source>&amp;Side:</source>
        <translation>&amp;Seite:</translation>
    </message>
    <message>
        <source>Planned &amp;on:</source>
        <translation>Geplant &amp;am:</translation>
    </message>
    <message>
        <source>&amp;Tags:</source>
        <translation>Schlag&amp;wörter:</translation>
    </message>
    <message>
        <source>&amp;Note:</source>
        <translation>&amp;Notiz:</translation>
    </message>
    <message>
        <source>&amp;Keep</source>
        <translation>&amp;Behalten</translation>
    </message>
    <message>
        <source>Do not name the patient here: tags, diagnosis, procedure and note go along when the case is handed on.</source>
        <translation>Nennen Sie hier nicht den Patienten: Schlagwörter, Diagnose, Eingriff und Notiz gehen mit, wenn der Fall weitergegeben wird.</translation>
    </message>
    <message>
        <source>a day, such as 2026-12-31 or 31.12.2026</source>
        <translation>ein Tag, etwa 31.12.2026 oder 2026-12-31</translation>
    </message>
    <message>
        <source>Of the planned operation, year-month-day or day.month.year. It stays here when the case is archived or sent</source>
        <translation>Der geplanten Operation, Tag.Monat.Jahr oder Jahr-Monat-Tag. Er bleibt hier, wenn der Fall archiviert oder gesendet wird</translation>
    </message>
    <message>
        <source>“%1” is not a day; give it as 2026-12-31 or 31.12.2026</source>
        <translation>„%1“ ist kein Tag; geben Sie ihn als 31.12.2026 oder 2026-12-31 an</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::DeviceTestDialog</name>
    <message>
        <source>%1: the handle does not follow the force. Do not use the device.</source>
        <translation>%1: Der Griff folgt der Kraft nicht. Benutzen Sie das Gerät nicht.</translation>
    </message>
    <message>
        <source>%1: stable up to %2 N/mm, a fault at %3</source>
        <translation>%1: stabil bis %2 N/mm, Fehler bei %3</translation>
    </message>
    <message>
        <source>%1: stable up to %2 N/mm, oscillates at %3</source>
        <translation>%1: stabil bis %2 N/mm, schwingt bei %3</translation>
    </message>
    <message>
        <source>%1: stable up to %2 N/mm</source>
        <translation>%1: stabil bis %2 N/mm</translation>
    </message>
    <message>
        <source>&amp;Keep this stiffness</source>
        <translation>Diese Steifigkeit &amp;behalten</translation>
    </message>
    <message>
        <source>Test of %1</source>
        <translation>Test von %1</translation>
    </message>
    <message>
        <source>This takes about a minute. First move the handle through all of its workspace and press its buttons. Then hold it lightly in the middle and keep it still: it is pushed along each axis, with 0.5 N, and held by a spring that becomes stiffer.</source>
        <translation>Das dauert etwa eine Minute. Führen Sie den Griff zuerst durch seinen ganzen Arbeitsraum und drücken Sie seine Tasten. Halten Sie ihn dann locker und ruhig in der Mitte: Er wird entlang jeder Achse mit 0,5 N gestoßen und von einer Feder gehalten, die steifer wird.</translation>
    </message>
    <message>
        <source>Bone is then rendered with at most that stiffness on this device</source>
        <translation>Knochen ist an diesem Gerät dann höchstens so steif</translation>
    </message>
    <message>
        <source>Stopped</source>
        <translation>Angehalten</translation>
    </message>
    <message>
        <source>&amp;Stop</source>
        <translation>An&amp;halten</translation>
    </message>
    <message>
        <source>S&amp;tart</source>
        <translation>&amp;Starten</translation>
    </message>
    <message>
        <source>Workspace %1 × %2 × %3 mm, %4 readings/s</source>
        <translation>Arbeitsraum %1 × %2 × %3 mm, %4 Messungen/s</translation>
    </message>
    <message>
        <source>It gives no force.</source>
        <translation>Es gibt keine Kraft.</translation>
    </message>
    <message>
        <source>Right</source>
        <translation>Rechts</translation>
    </message>
    <message>
        <source>Up</source>
        <translation>Oben</translation>
    </message>
    <message>
        <source>To the user</source>
        <translation>Zum Benutzer</translation>
    </message>
    <message>
        <source>Proposed: %1 N/mm</source>
        <translation>Vorschlag: %1 N/mm</translation>
    </message>
    <message>
        <source>No stiffness is proposed.</source>
        <translation>Keine Steifigkeit wird vorgeschlagen.</translation>
    </message>
    <message>
        <source>Kept for this device</source>
        <translation>Für dieses Gerät behalten</translation>
    </message>
    <message>
        <source>The device reported a fault once</source>
        <translation>Das Gerät meldete einen Fehler</translation>
    </message>
    <message>
        <source>The device reported a fault %1 times</source>
        <translation>Das Gerät meldete %1 Fehler</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::DeviceToolBar</name>
    <message>
        <source>Mouse</source>
        <translation>Maus</translation>
    </message>
    <message>
        <source>Device</source>
        <translation>Gerät</translation>
    </message>
    <message>
        <source>What leads the tool: the mouse, a SpaceMouse, or a device behind a device server. What is plugged in comes up by itself.
X, or the device&apos;s second button, held: the hand moves alone.</source>
        <translation>Was das Werkzeug führt: die Maus, eine SpaceMouse oder ein Gerät hinter einem Geräteserver. Was angesteckt wird, erscheint von selbst.
X oder die zweite Taste des Geräts, gehalten: Nur die Hand bewegt sich.</translation>
    </message>
    <message>
        <source>Millimetres that the tool goes for a millimetre of the hand</source>
        <translation>Millimeter, die das Werkzeug je Millimeter der Hand geht</translation>
    </message>
    <message>
        <source> mm/mm</source>
        <translation> mm/mm</translation>
    </message>
    <message>
        <source>The strongest force that the device may give, N</source>
        <translation>Die größte Kraft, die das Gerät geben darf, N</translation>
    </message>
    <message>
        <source> N</source>
        <translation> N</translation>
    </message>
    <message>
        <source>Bring the tool &amp;here</source>
        <translation>Werkzeug &amp;hierher holen</translation>
    </message>
    <message>
        <source>Brings the tool of a device before what is in the middle of the view (H)</source>
        <translation>Holt das Werkzeug eines Geräts vor das, was in der Mitte der Ansicht ist (H)</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>Maßstab</translation>
    </message>
    <message>
        <source>At most</source>
        <translation>Höchstens</translation>
    </message>
    <message>
        <source>&amp;Test the device…</source>
        <translation>G&amp;erät testen…</translation>
    </message>
    <message>
        <source>&amp;Connect a device…</source>
        <translation>Gerät &amp;anschließen…</translation>
    </message>
    <message>
        <source>Workspace, directions of the forces, and the stiffness that it bears</source>
        <translation>Arbeitsraum, Richtungen der Kräfte und die Steifigkeit, die es verträgt</translation>
    </message>
    <message>
        <source>Opens the manual in the browser: which devices there are, and how they come into this list</source>
        <translation>Öffnet das Handbuch im Browser: welche Geräte es gibt und wie sie in diese Liste kommen</translation>
    </message>
    <message>
        <source>Connect or test a device</source>
        <translation>Gerät anschließen oder testen</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::DeviceWatcher</name>
    <message>
        <source>%1 cannot be opened</source>
        <translation>%1 lässt sich nicht öffnen</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::DiameterBox</name>
    <message>
        <source>Burrs of %1 mm</source>
        <translation>Fräsen von %1 mm</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::DrillBar</name>
    <message>
        <source>Drill</source>
        <translation>Bohren</translation>
    </message>
    <message>
        <source>Pointer</source>
        <translation>Zeiger</translation>
    </message>
    <message>
        <source>By wheel</source>
        <translation>Mit dem Rad</translation>
    </message>
    <message>
        <source> N</source>
        <translation> N</translation>
    </message>
    <message>
        <source>Pointer (P): touches and cuts nothing; reads the image, structure and the distance to the nearest surface at its tip</source>
        <translation>Zeiger (P): berührt und trägt nichts ab; liest an seiner Spitze das Bild, die Struktur und den Abstand zur nächsten Oberfläche</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
    <message>
        <source>Cutting</source>
        <translation>Schneidend</translation>
    </message>
    <message>
        <source>Diamond</source>
        <translation>Diamant</translation>
    </message>
    <message>
        <source> krpm</source>
        <translation> krpm</translation>
    </message>
    <message>
        <source>Speed of the spindle, thousands of turns a minute: the faster it turns, the faster the burr goes in</source>
        <translation>Drehzahl der Spindel, tausend Umdrehungen je Minute: Je schneller sie dreht, desto schneller dringt die Fräse ein</translation>
    </message>
    <message>
        <source>The wheel moves the burr in depth, 0.25 mm a notch, with Shift a fifth of it (M); how far it is wanted in the tissue is how hard it presses, 1 N for a mm.
Without it the burr lies on the tissue and is pressed with the thrust. Ctrl with the wheel zooms.</source>
        <translation>Das Rad bewegt die Fräse in die Tiefe, 0,25 mm je Raste, mit Umschalt ein Fünftel davon (M); wie weit sie im Gewebe sein soll, ist, wie fest sie drückt, 1 N je mm.
Ohne dies liegt die Fräse auf dem Gewebe und wird mit dem Andruck gedrückt. Strg mit dem Rad zoomt.</translation>
    </message>
    <message>
        <source>Burr</source>
        <translation>Fräse</translation>
    </message>
    <message>
        <source>Kind of the burr</source>
        <translation>Art der Fräse</translation>
    </message>
    <message>
        <source>Speed of the spindle</source>
        <translation>Drehzahl der Spindel</translation>
    </message>
    <message>
        <source>Thrust</source>
        <translation>Andruck</translation>
    </message>
    <message>
        <source>How hard a hand without force (mouse, SpaceMouse) presses the burr on the tissue, N: the harder, the faster it goes in.
The wheel changes it while the burr drills, 0.5 N a notch, with Shift a fifth of it. While Shift is held, it is twice as large</source>
        <translation>Andruck, mit dem eine Hand ohne Kraft (Maus, SpaceMouse) die Fräse auf das Gewebe drückt, N: je fester, desto schneller dringt sie ein.
Das Rad ändert ihn, während die Fräse bohrt, 0,5 N je Raste, mit Umschalt ein Fünftel davon. Solange Umschalt gehalten wird, ist er doppelt so groß</translation>
    </message>
    <message>
        <source>I&amp;nstrument</source>
        <translation>I&amp;nstrument</translation>
    </message>
    <message>
        <source>Diamond burr</source>
        <translation>Diamantfräse</translation>
    </message>
    <message>
        <source>Cutting burr</source>
        <translation>Schneidende Fräse</translation>
    </message>
    <message>
        <source>Instrument</source>
        <translation>Instrument</translation>
    </message>
    <message>
        <source>Pick, dissector or curette from a file (I): the left button, or Space, presses it on the tissue, and it removes nothing</source>
        <translation>Häkchen, Dissektor oder Kürette aus einer Datei (I): Die linke Taste oder die Leertaste drückt es auf das Gewebe; es trägt nichts ab</translation>
    </message>
    <message>
        <source>This library has no burr “%1”; “%2” is taken in its place (Drill &gt; Materials and burrs…)</source>
        <translation>Diese Bibliothek hat keine Fräse „%1“; an ihrer Stelle steht „%2“ (Bohren &gt; Materialien und Fräsen…)</translation>
    </message>
    <message>
        <source>The hand on the device moves the burr in depth</source>
        <translation>Die Hand am Gerät bewegt die Fräse in die Tiefe</translation>
    </message>
    <message>
        <source>The hand on the device presses the burr itself</source>
        <translation>Die Hand am Gerät drückt die Fräse selbst an</translation>
    </message>
    <message>
        <source>Diameter of the burr, mm, of those that are sold (A or [ smaller, S or ] larger)</source>
        <translation>Durchmesser der Fräse, mm, unter den erhältlichen (A oder [ kleiner, S oder ] größer)</translation>
    </message>
    <message>
        <source>Drill mode (D): the left button, or Space, drills where the burr lies.
Let go, it lifts by a millimetre and rests there: the handpiece has no weight, and X holds it in place.
Without it a drag turns the patient.</source>
        <translation>Bohrmodus (D): Die linke Taste oder die Leertaste bohrt, wo die Fräse liegt.
Losgelassen, hebt sie sich um einen Millimeter und ruht dort: Das Handstück hat kein Gewicht, und X hält es an seinem Ort.
Ohne ihn dreht Ziehen den Patienten.</translation>
    </message>
    <message>
        <source>Diamond, coarse</source>
        <translation>Diamant, grob</translation>
    </message>
    <message>
        <source>Diamond, medium</source>
        <translation>Diamant, mittel</translation>
    </message>
    <message>
        <source>Diamond, fine</source>
        <translation>Diamant, fein</translation>
    </message>
    <message>
        <source>Diamond, extra fine</source>
        <translation>Diamant, extrafein</translation>
    </message>
    <message>
        <source>Cutting, rake -6°</source>
        <translation>Schneidend, Spanwinkel -6°</translation>
    </message>
    <message>
        <source>Cutting, rake -25°</source>
        <translation>Schneidend, Spanwinkel -25°</translation>
    </message>
    <message>
        <source>Kind of the burr: a cutting burr takes several times as much in the same time as a diamond one, and a fine diamond the least. More burrs: Drill &gt; Materials and burrs…</source>
        <translation>Art der Fräse: Eine schneidende trägt in derselben Zeit mehrmals so viel ab wie eine Diamantfräse, ein feiner Diamant am wenigsten. Weitere Fräsen: Bohren &gt; Materialien und Fräsen…</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::DrillController</name>
    <message>
        <source>%1 mm to the surface</source>
        <translation>%1 mm bis zur Oberfläche</translation>
    </message>
    <message>
        <source>no surface within %1 mm</source>
        <translation>keine Oberfläche innerhalb von %1 mm</translation>
    </message>
    <message>
        <source>%1 mm to %2</source>
        <translation>%1 mm bis %2</translation>
    </message>
    <message>
        <source>Thrust %1 N</source>
        <translation>Andruck %1 N</translation>
    </message>
    <message>
        <source>Point at the patient in the 3D view: there the tool comes</source>
        <translation>Zeigen Sie in der 3D-Ansicht auf den Patienten: Dorthin kommt das Werkzeug</translation>
    </message>
    <message>
        <source>The case is still being prepared; then the tool can be taken up</source>
        <translation>Der Fall wird noch vorbereitet; dann lässt sich das Werkzeug aufnehmen</translation>
    </message>
    <message>
        <source>Taking up the burr…</source>
        <translation>Die Fräse wird aufgenommen…</translation>
    </message>
    <message>
        <source>Taking up the pointer…</source>
        <translation>Der Zeiger wird aufgenommen…</translation>
    </message>
    <message>
        <source>The tool cannot be taken up: the computer has no room for it. Close other programs.</source>
        <translation>Das Werkzeug lässt sich nicht aufnehmen: Der Rechner hat keinen Platz dafür. Schließen Sie andere Programme.</translation>
    </message>
    <message>
        <source>%1 leads the tool</source>
        <translation>%1 führt das Werkzeug</translation>
    </message>
    <message>
        <source>What is drilled is not on the disk yet: %1</source>
        <translation>Das Gebohrte ist noch nicht auf der Platte: %1</translation>
    </message>
    <message>
        <source>%1 was unplugged</source>
        <translation>%1 wurde ausgesteckt</translation>
    </message>
    <message>
        <source>%1 gives no place any more</source>
        <translation>%1 gibt keinen Ort mehr an</translation>
    </message>
    <message>
        <source>The burr has lifted: what lies under the pointer is another surface, far deeper or higher. Let go and press again to drill there.</source>
        <translation>Die Fräse hat abgehoben: Unter dem Mauszeiger liegt eine andere Oberfläche, weit tiefer oder höher. Lassen Sie los und drücken Sie erneut, um dort zu bohren.</translation>
    </message>
    <message>
        <source>The shaft lies on tissue and holds the burr off</source>
        <translation>Der Schaft liegt auf Gewebe und hält die Fräse ab</translation>
    </message>
    <message>
        <source>The handpiece lies on tissue and holds the burr off</source>
        <translation>Das Handstück liegt auf Gewebe und hält die Fräse ab</translation>
    </message>
    <message>
        <source>Shaft and handpiece lie on tissue and hold the burr off</source>
        <translation>Schaft und Handstück liegen auf Gewebe und halten die Fräse ab</translation>
    </message>
    <message>
        <source>The burr lies on %1, which is set not to be drilled</source>
        <translation>Die Fräse liegt auf %1; laut Einstellung wird diese Struktur nicht gebohrt</translation>
    </message>
    <message>
        <source>The burr is pressed and makes no way: what holds it is not taken at this thrust and speed</source>
        <translation>Die Fräse wird angedrückt und kommt nicht voran: Was sie hält, wird bei diesem Andruck und dieser Drehzahl nicht abgetragen</translation>
    </message>
    <message>
        <source>The device turns the handpiece by itself</source>
        <translation>Das Gerät dreht das Handstück selbst</translation>
    </message>
    <message>
        <source>Handpiece: %1° from the line of sight, at %2° on the screen</source>
        <translation>Handstück: %1° zur Blickrichtung, bei %2° auf dem Bildschirm</translation>
    </message>
    <message>
        <source>Instrument from a file</source>
        <translation>Instrument aus einer Datei</translation>
    </message>
    <message>
        <source>Surfaces (%1)</source>
        <translation>Oberflächen (%1)</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Reading the instrument…</source>
        <translation>Das Instrument wird gelesen…</translation>
    </message>
    <message>
        <source>Taking up the instrument…</source>
        <translation>Das Instrument wird aufgenommen…</translation>
    </message>
    <message>
        <source>Drill &gt; Instrument takes it up when the stroke is done</source>
        <translation>Bohren &gt; Instrument nimmt es auf, wenn der Bohrzug beendet ist</translation>
    </message>
    <message>
        <source>distances to structures: being measured…</source>
        <translation>Abstände zu Strukturen: werden gemessen…</translation>
    </message>
    <message>
        <source>The instrument&apos;s file is not there any more, under this name at least:
%1</source>
        <translation>Die Datei des Instruments ist nicht mehr da, jedenfalls nicht unter diesem Namen:
%1</translation>
    </message>
    <message>
        <source>Reading the instrument… %1 %</source>
        <translation>Das Instrument wird gelesen… %1 %</translation>
    </message>
    <message>
        <source>%1: %2 × %3 mm, the tip at %4 = %5 mm</source>
        <translation>%1: %2 × %3 mm, die Spitze bei %4 = %5 mm</translation>
    </message>
    <message>
        <source>From its tip to the hand the instrument lies along this axis of its file
(length × width, and where its tip is then):</source>
        <translation>Von der Spitze zur Hand liegt das Instrument entlang dieser Achse seiner Datei
(Länge × Breite, und wo die Spitze dann ist):</translation>
    </message>
    <message>
        <source>instrument</source>
        <translation>Instrument</translation>
    </message>
    <message>
        <source>Shaft or handpiece keep the burr from where you press: turn the handpiece, or press where the burr rests</source>
        <translation>Schaft oder Handstück halten die Fräse von der gedrückten Stelle ab: Handstück drehen oder dort drücken, wo die Fräse anliegt</translation>
    </message>
    <message>
        <source>Tissue keeps the burr from where you press: press where the burr rests</source>
        <translation>Gewebe hält die Fräse von der gedrückten Stelle ab: dort drücken, wo die Fräse anliegt</translation>
    </message>
    <message>
        <source>The case keeps no instrument from the next save on</source>
        <translation>Der Fall behält ab dem nächsten Speichern kein Instrument</translation>
    </message>
    <message>
        <source>The case does not keep %1 from the next save on</source>
        <translation>Der Fall behält %1 ab dem nächsten Speichern nicht mehr</translation>
    </message>
    <message>
        <source>Drill &gt; Instrument takes it up again while its file is there</source>
        <translation>Bohren &gt; Instrument nimmt es wieder auf, solange seine Datei da ist</translation>
    </message>
    <message>
        <source>From here the hand would come from behind the picture: look at the left ear first, as in Surgical position (8)</source>
        <translation>Von hier aus käme die Hand hinter dem Bild hervor: Sehen Sie zuerst auf das linke Ohr, wie in Operationslage (8)</translation>
    </message>
    <message>
        <source>From here the hand would come from behind the picture: look at the right ear first, as in Surgical position (9)</source>
        <translation>Von hier aus käme die Hand hinter dem Bild hervor: Sehen Sie zuerst auf das rechte Ohr, wie in Operationslage (9)</translation>
    </message>
    <message>
        <source>Handpiece for the left ear: %1° from the line of sight, at %2° on the screen</source>
        <translation>Handstück für das linke Ohr: %1° zur Blickrichtung, bei %2° auf dem Bildschirm</translation>
    </message>
    <message>
        <source>Handpiece for the right ear: %1° from the line of sight, at %2° on the screen</source>
        <translation>Handstück für das rechte Ohr: %1° zur Blickrichtung, bei %2° auf dem Bildschirm</translation>
    </message>
    <message>
        <source>Which ear it is, is not known: state the side first (Case &gt; Side)</source>
        <translation>Welches Ohr es ist, ist nicht bekannt: zuerst die Seite angeben (Fall &gt; Seite)</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::DrillSound</name>
    <message>
        <source>The sound output is gone; the drill is not heard any more</source>
        <translation>Die Tonausgabe ist weg; der Bohrer ist nicht mehr zu hören</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ExchangeController</name>
    <message>
        <source>1 object, %1 MB in %2 s</source>
        <translation>1 Objekt, %1 MB in %2 s</translation>
    </message>
    <message>
        <source>%1 objects, %2 MB in %3 s</source>
        <translation>%1 Objekte, %2 MB in %3 s</translation>
    </message>
    <message>
        <source>, %1 of them were there already</source>
        <translation>, %1 davon waren schon dort</translation>
    </message>
    <message>
        <source>, %1 with a warning of the node</source>
        <translation>, %1 mit einer Warnung des Knotens</translation>
    </message>
    <message>
        <source>The node was asked, and has all of them.</source>
        <translation>Der Knoten wurde gefragt und hat sie alle.</translation>
    </message>
    <message>
        <source>The node confirmed each of them, but lists none of them (yet), so they could not be counted there.</source>
        <translation>Der Knoten hat jedes bestätigt, führt aber (noch) keines auf, sodass sie dort nicht gezählt werden konnten.</translation>
    </message>
    <message>
        <source>The node confirmed each of them, but did not answer when it was asked for them, so they could not be counted there.</source>
        <translation>Der Knoten hat jedes bestätigt, antwortete aber nicht auf die Frage danach, sodass sie dort nicht gezählt werden konnten.</translation>
    </message>
    <message>
        <source>The node confirmed each of them. It offers no queries, so they could not be counted there.</source>
        <translation>Der Knoten hat jedes bestätigt. Er bietet keine Abfragen, sodass sie dort nicht gezählt werden konnten.</translation>
    </message>
    <message>
        <source>&amp;Send to a node…</source>
        <translation>An einen Knoten &amp;senden…</translation>
    </message>
    <message>
        <source>The open case to a DICOM node</source>
        <translation>Der offene Fall an einen DICOM-Knoten</translation>
    </message>
    <message>
        <source>Open a case first, or choose one in the list (Library &gt; Cases).</source>
        <translation>Öffnen Sie zuerst einen Fall oder wählen Sie einen in der Liste (Bibliothek &gt; Fälle).</translation>
    </message>
    <message>
        <source>R&amp;eceive from a node…</source>
        <translation>Von einem Knoten &amp;empfangen…</translation>
    </message>
    <message>
        <source>A case, or images of a patient, from a DICOM node</source>
        <translation>Ein Fall oder Bilder eines Patienten von einem DICOM-Knoten</translation>
    </message>
    <message>
        <source>DICOM &amp;nodes…</source>
        <translation>DICOM-&amp;Knoten…</translation>
    </message>
    <message>
        <source>Where cases are sent to and received from</source>
        <translation>Wohin Fälle gesendet und woher sie empfangen werden</translation>
    </message>
    <message>
        <source>De-&amp;identify DICOM files…</source>
        <translation>&amp;DICOM-Dateien de-identifizieren…</translation>
    </message>
    <message>
        <source>A folder of DICOM files without what identifies the patient</source>
        <translation>Ein Ordner von DICOM-Dateien ohne das, was den Patienten kennzeichnet</translation>
    </message>
    <message>
        <source>Pseud&amp;onyms…</source>
        <translation>Pseud&amp;onyme…</translation>
    </message>
    <message>
        <source>Who is behind the pseudonyms of de-identified files</source>
        <translation>Wer hinter den Pseudonymen de-identifizierter Dateien steht</translation>
    </message>
    <message>
        <source>Petrous</source>
        <translation>Petrous</translation>
    </message>
    <message>
        <source>The case is not saved yet, so it was not sent</source>
        <translation>Der Fall ist noch nicht gespeichert, daher wurde er nicht gesendet</translation>
    </message>
    <message>
        <source>Opening %1</source>
        <translation>%1 wird geöffnet</translation>
    </message>
    <message>
        <source>Sending %1</source>
        <translation>%1 wird gesendet</translation>
    </message>
    <message>
        <source>“%1” is at “%2”: %3.</source>
        <translation>„%1“ ist bei „%2“: %3.</translation>
    </message>
    <message>
        <source>Send</source>
        <translation>Senden</translation>
    </message>
    <message>
        <source>Receiving from %1</source>
        <translation>Empfang von %1</translation>
    </message>
    <message>
        <source>Received: %1</source>
        <translation>Empfangen: %1</translation>
    </message>
    <message>
        <source>Receive</source>
        <translation>Empfangen</translation>
    </message>
    <message>
        <source>“%1” is received: %2.</source>
        <translation>„%1“ ist empfangen: %2.</translation>
    </message>
    <message>
        <source>The library has a case “%1”. Name of the received one:</source>
        <translation>Die Bibliothek hat einen Fall „%1“. Name des empfangenen:</translation>
    </message>
    <message>
        <source>Stopped; nothing was changed</source>
        <translation>Angehalten; nichts wurde geändert</translation>
    </message>
    <message>
        <source>received</source>
        <translation>empfangen</translation>
    </message>
    <message>
        <source>De-identifying</source>
        <translation>De-Identifizierung läuft</translation>
    </message>
    <message>
        <source>%1 files are de-identified in %2.</source>
        <translation>%1 Dateien sind in %2 de-identifiziert.</translation>
    </message>
    <message>
        <source>%1 were left out.</source>
        <translation>%1 wurden ausgelassen.</translation>
    </message>
    <message>
        <source>%1 files: %2</source>
        <translation>%1 Dateien: %2</translation>
    </message>
    <message>
        <source>The disk reported an error; check the disk.</source>
        <translation>Die Platte meldete einen Fehler; prüfen Sie die Platte.</translation>
    </message>
    <message>
        <source>De-identify</source>
        <translation>De-identifizieren</translation>
    </message>
    <message>
        <source>There it is the patient %1. Receive finds it by the case “%2”.</source>
        <translation>Dort ist er der Patient %1. „Empfangen“ findet ihn unter dem Fall „%2“.</translation>
    </message>
    <message>
        <source>There it is the patient %1, without the case&apos;s name, which may be a patient&apos;s. Receive finds it by the whole name “%2” from this library, and by that ID from any; “petrous receive” finds it by the study %3.</source>
        <translation>Dort ist es der Patient %1, ohne den Namen des Falls, der der eines Patienten sein kann. „Empfangen“ findet ihn aus dieser Bibliothek unter dem ganzen Namen „%2“ und aus jeder unter dieser ID; „petrous receive“ findet ihn unter der Studie %3.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ExportDialog</name>
    <message>
        <source>Resampled on the &amp;primary MR&apos;s grid</source>
        <translation>Auf das Gitter des &amp;primären MR umgerechnet</translation>
    </message>
    <message>
        <source>Resampled on the &amp;CT&apos;s grid</source>
        <translation>Auf das Gitter des &amp;CT umgerechnet</translation>
    </message>
    <message>
        <source>Put a&amp;ir in place of the face</source>
        <translation>Das &amp;Gesicht durch Luft ersetzen</translation>
    </message>
    <message>
        <source>Export from “%1”</source>
        <translation>Aus „%1“ exportieren</translation>
    </message>
    <message>
        <source>MR of the case</source>
        <translation>MR des Falls</translation>
    </message>
    <message>
        <source>%1 after drilling</source>
        <translation>%1 nach dem Bohren</translation>
    </message>
    <message>
        <source>MR beside it</source>
        <translation>MR daneben</translation>
    </message>
    <message>
        <source>MR</source>
        <translation>MR</translation>
    </message>
    <message>
        <source>Structures as labels</source>
        <translation>Strukturen als Labels</translation>
    </message>
    <message>
        <source>Surface of a structure</source>
        <translation>Oberfläche einer Struktur</translation>
    </message>
    <message>
        <source>Surface of the tissue after drilling</source>
        <translation>Oberfläche des Gewebes nach dem Bohren</translation>
    </message>
    <message>
        <source>Surface of the bone after drilling</source>
        <translation>Oberfläche des Knochens nach dem Bohren</translation>
    </message>
    <message>
        <source>What is left of each voxel (mask)</source>
        <translation>Was von jedem Voxel übrig ist (Maske)</translation>
    </message>
    <message>
        <source>Otherwise on its own grid</source>
        <translation>Sonst auf seinem eigenen Gitter</translation>
    </message>
    <message>
        <source>In front of a plane about 50 mm behind the tip of the nose. What is segmented or drilled and the temporal bones stay; the case here does not change</source>
        <translation>Vor einer Ebene etwa 50 mm hinter der Nasenspitze. Was segmentiert oder gebohrt ist und die Felsenbeine bleiben; der Fall hier ändert sich nicht</translation>
    </message>
    <message>
        <source>all</source>
        <translation>alle</translation>
    </message>
    <message>
        <source>With fewer triangles than it has, how far the surface lies off is stated in mm</source>
        <translation>Bei weniger Dreiecken, als sie hat, wird in mm angegeben, wie weit die Oberfläche abweicht</translation>
    </message>
    <message>
        <source>&amp;Browse…</source>
        <translation>&amp;Durchsuchen…</translation>
    </message>
    <message>
        <source>&amp;What:</source>
        <translation>&amp;Was:</translation>
    </message>
    <message>
        <source>&amp;Part:</source>
        <translation>&amp;Teil:</translation>
    </message>
    <message>
        <source>&amp;Format:</source>
        <translation>&amp;Format:</translation>
    </message>
    <message>
        <source>At most triangle&amp;s:</source>
        <translation>Höchstens D&amp;reiecke:</translation>
    </message>
    <message>
        <source>Coordinates:</source>
        <translation>Koordinaten:</translation>
    </message>
    <message>
        <source>&amp;To:</source>
        <translation>&amp;Nach:</translation>
    </message>
    <message>
        <source>&amp;Export</source>
        <translation>&amp;Exportieren</translation>
    </message>
    <message>
        <source>all structures</source>
        <translation>alle Strukturen</translation>
    </message>
    <message>
        <source>DICOM series (a folder)</source>
        <translation>DICOM-Serie (ein Ordner)</translation>
    </message>
    <message>
        <source>Give a file with its whole path, or choose one.</source>
        <translation>Geben Sie eine Datei mit vollem Pfad an oder wählen Sie eine.</translation>
    </message>
    <message>
        <source>There is no folder %1.</source>
        <translation>Es gibt keinen Ordner %1.</translation>
    </message>
    <message>
        <source>Nothing can be written in %1.</source>
        <translation>In %1 kann nichts geschrieben werden.</translation>
    </message>
    <message>
        <source>The name must end in %1.</source>
        <translation>Der Name muss auf %1 enden.</translation>
    </message>
    <message>
        <source>%1 GB are free there.</source>
        <translation>Dort sind %1 GB frei.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::FilmDialog</name>
    <message>
        <source>Film</source>
        <translation>Film</translation>
    </message>
    <message>
        <source>&amp;Write the film</source>
        <translation>Film &amp;schreiben</translation>
    </message>
    <message>
        <source>Once around the patient</source>
        <translation>Einmal um den Patienten</translation>
    </message>
    <message>
        <source>Along “%1”</source>
        <translation>Entlang „%1“</translation>
    </message>
    <message>
        <source>A flight goes along the centre line of a canal or nerve, which is not drawn then</source>
        <translation>Ein Flug geht entlang der Mittellinie eines Kanals oder Nervs, der dann nicht gezeichnet wird</translation>
    </message>
    <message>
        <source>25 a second in a video</source>
        <translation>25 je Sekunde in einem Video</translation>
    </message>
    <message>
        <source>&amp;Camera:</source>
        <translation>&amp;Kamera:</translation>
    </message>
    <message>
        <source>F&amp;rames:</source>
        <translation>&amp;Bilder:</translation>
    </message>
    <message>
        <source>A name that ends in .mp4 writes a video, in .png a picture for each frame.</source>
        <translation>Ein Name, der auf .mp4 endet, schreibt ein Video, auf .png ein Bild je Einzelbild.</translation>
    </message>
    <message>
        <source>film</source>
        <translation>Film</translation>
    </message>
    <message>
        <source>Let the name end in .mp4 or .png.</source>
        <translation>Der Name soll auf .mp4 oder .png enden.</translation>
    </message>
    <message>
        <source>A video needs the program ffmpeg, which is not installed (Debian&apos;s package ffmpeg). Let the name end in .png.</source>
        <translation>Ein Video braucht das Programm ffmpeg, das nicht installiert ist (Debians Paket ffmpeg). Lassen Sie den Namen auf .png enden.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::FoldBox</name>
    <message>
        <source>Shows or hides what belongs to it</source>
        <translation>Zeigt oder verbirgt, was dazugehört</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::HandlesBox</name>
    <message>
        <source>Step</source>
        <translation>Schritt</translation>
    </message>
    <message>
        <source>1 mm, 1°</source>
        <translation>1 mm, 1°</translation>
    </message>
    <message>
        <source>What a press of a button below moves or turns the MR. In a slice: Alt+arrow moves it in the slice, Alt+Page up and down turn it; with Shift by the larger step</source>
        <translation>Wie weit ein Druck auf eine Taste unten das MR bewegt oder dreht. In einer Schicht: Alt+Pfeil bewegt es in der Schicht, Alt+Bild auf und ab drehen es; mit Umschalt um den größeren Schritt</translation>
    </message>
    <message>
        <source>Moves the MR to the patient&apos;s right</source>
        <translation>Bewegt das MR zur Rechten des Patienten</translation>
    </message>
    <message>
        <source>Moves the MR to the patient&apos;s left</source>
        <translation>Bewegt das MR zur Linken des Patienten</translation>
    </message>
    <message>
        <source>Moves the MR to the front</source>
        <translation>Bewegt das MR nach vorn</translation>
    </message>
    <message>
        <source>Moves the MR to the back</source>
        <translation>Bewegt das MR nach hinten</translation>
    </message>
    <message>
        <source>Moves the MR towards the feet</source>
        <translation>Bewegt das MR zu den Füßen</translation>
    </message>
    <message>
        <source>Moves the MR towards the head</source>
        <translation>Bewegt das MR zum Kopf</translation>
    </message>
    <message>
        <source>Turns the MR about the crosshair, against the clock for who looks to the left</source>
        <translation>Dreht das MR um das Fadenkreuz, gegen den Uhrzeiger für den Blick nach links</translation>
    </message>
    <message>
        <source>Turns the MR about the crosshair, with the clock for who looks to the left</source>
        <translation>Dreht das MR um das Fadenkreuz, mit dem Uhrzeiger für den Blick nach links</translation>
    </message>
    <message>
        <source>Turns the MR about the crosshair, against the clock for who looks to the back</source>
        <translation>Dreht das MR um das Fadenkreuz, gegen den Uhrzeiger für den Blick nach hinten</translation>
    </message>
    <message>
        <source>Turns the MR about the crosshair, with the clock for who looks to the back</source>
        <translation>Dreht das MR um das Fadenkreuz, mit dem Uhrzeiger für den Blick nach hinten</translation>
    </message>
    <message>
        <source>Turns the MR about the crosshair, against the clock for who looks to the head</source>
        <translation>Dreht das MR um das Fadenkreuz, gegen den Uhrzeiger für den Blick zum Kopf</translation>
    </message>
    <message>
        <source>Turns the MR about the crosshair, with the clock for who looks to the head</source>
        <translation>Dreht das MR um das Fadenkreuz, mit dem Uhrzeiger für den Blick zum Kopf</translation>
    </message>
    <message>
        <source>Middle to the crosshair</source>
        <translation>Mitte ins Fadenkreuz</translation>
    </message>
    <message>
        <source>The MR&apos;s middle goes to the crosshair: for images that lie far apart</source>
        <translation>Die Mitte des MR kommt ins Fadenkreuz: für Bilder, die weit auseinanderliegen</translation>
    </message>
    <message>
        <source>By hand: %1 mm at the crosshair, %2°</source>
        <translation>Von Hand: %1 mm am Fadenkreuz, %2°</translation>
    </message>
    <message>
        <source>Not moved by hand</source>
        <translation>Nicht von Hand bewegt</translation>
    </message>
    <message>
        <source>0.1 mm, 0.1°</source>
        <translation>0,1 mm, 0,1°</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::KeyList</name>
    <message>
        <source>Keys</source>
        <translation>Tasten</translation>
    </message>
    <message>
        <source>Search keys and what they do</source>
        <translation>Tasten und ihre Wirkung durchsuchen</translation>
    </message>
    <message>
        <source>Search keys</source>
        <translation>Tasten durchsuchen</translation>
    </message>
    <message>
        <source>Key</source>
        <translation>Taste</translation>
    </message>
    <message>
        <source>Command</source>
        <translation>Befehl</translation>
    </message>
    <message>
        <source>What it does</source>
        <translation>Was sie tut</translation>
    </message>
    <message>
        <source>3D view</source>
        <translation>3D-Ansicht</translation>
    </message>
    <message>
        <source>Turn the patient</source>
        <translation>Den Patienten drehen</translation>
    </message>
    <message>
        <source>drag</source>
        <translation>ziehen</translation>
    </message>
    <message>
        <source>Zoom</source>
        <translation>Zoomen</translation>
    </message>
    <message>
        <source>wheel</source>
        <translation>Rad</translation>
    </message>
    <message>
        <source>With Depth by wheel on: Ctrl with the wheel</source>
        <translation>Bei Tiefe mit dem Rad: Strg mit dem Rad</translation>
    </message>
    <message>
        <source>Crosshair on the surface</source>
        <translation>Fadenkreuz auf die Oberfläche</translation>
    </message>
    <message>
        <source>click</source>
        <translation>Klick</translation>
    </message>
    <message>
        <source>Enlarge, and back</source>
        <translation>Vergrößern und zurück</translation>
    </message>
    <message>
        <source>double click</source>
        <translation>Doppelklick</translation>
    </message>
    <message>
        <source>Drill, while the drill is on</source>
        <translation>Bohren, solange der Bohrer eingeschaltet ist</translation>
    </message>
    <message>
        <source>Space, or the left button</source>
        <translation>Leertaste oder linke Taste</translation>
    </message>
    <message>
        <source>With Ctrl the button presses the burr without drilling</source>
        <translation>Mit Strg drückt die Taste die Fräse an, ohne zu bohren</translation>
    </message>
    <message>
        <source>Clutch</source>
        <translation>Kupplung</translation>
    </message>
    <message>
        <source>X</source>
        <translation>X</translation>
    </message>
    <message>
        <source>Held: the tool stays while hand or mouse goes on</source>
        <translation>Gehalten: Das Werkzeug bleibt, während Hand oder Maus weitergehen</translation>
    </message>
    <message>
        <source>Slices</source>
        <translation>Schichten</translation>
    </message>
    <message>
        <source>Move the crosshair</source>
        <translation>Fadenkreuz bewegen</translation>
    </message>
    <message>
        <source>click or drag, arrow keys</source>
        <translation>Klick oder ziehen, Pfeiltasten</translation>
    </message>
    <message>
        <source>Through the slices</source>
        <translation>Durch die Schichten</translation>
    </message>
    <message>
        <source>wheel, Page up, Page down</source>
        <translation>Rad, Bild auf, Bild ab</translation>
    </message>
    <message>
        <source>Ctrl with the wheel, + and -</source>
        <translation>Strg mit dem Rad, + und -</translation>
    </message>
    <message>
        <source>Move the picture</source>
        <translation>Bild bewegen</translation>
    </message>
    <message>
        <source>drag with the middle button</source>
        <translation>mit der mittleren Taste ziehen</translation>
    </message>
    <message>
        <source>Window and level</source>
        <translation>Fensterbreite und Zentrum</translation>
    </message>
    <message>
        <source>drag with the right button</source>
        <translation>mit der rechten Taste ziehen</translation>
    </message>
    <message>
        <source>Turn the other two planes</source>
        <translation>Die anderen beiden Ebenen drehen</translation>
    </message>
    <message>
        <source>Ctrl and drag, Ctrl+left, Ctrl+right</source>
        <translation>Strg und ziehen, Strg+links, Strg+rechts</translation>
    </message>
    <message>
        <source>Tilt the slice</source>
        <translation>Schicht kippen</translation>
    </message>
    <message>
        <source>Ctrl+up, Ctrl+down</source>
        <translation>Strg+auf, Strg+ab</translation>
    </message>
    <message>
        <source>With Shift and left or right about its other axis</source>
        <translation>Mit Umschalt und links oder rechts um ihre andere Achse</translation>
    </message>
    <message>
        <source>Move the MR</source>
        <translation>MR bewegen</translation>
    </message>
    <message>
        <source>Alt with the arrow keys, Page up, Page down</source>
        <translation>Alt mit den Pfeiltasten, Bild auf, Bild ab</translation>
    </message>
    <message>
        <source>Where an MR lies over the slice; with Shift by the larger step</source>
        <translation>Wo ein MR über der Schicht liegt; mit Umschalt um den größeren Schritt</translation>
    </message>
    <message>
        <source>Back from the enlarged view</source>
        <translation>Zurück aus der vergrößerten Ansicht</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Of a slice, too</source>
        <translation>Auch aus einer Schicht</translation>
    </message>
    <message>
        <source>Crop box</source>
        <translation>Beschnittquader</translation>
    </message>
    <message>
        <source>drag an edge or a corner</source>
        <translation>Kante oder Ecke ziehen</translation>
    </message>
    <message>
        <source>While it is shown; in the 3D view drag the middle of a face. A double click on an edge shows all of the image</source>
        <translation>Solange er gezeigt wird; in der 3D-Ansicht die Mitte einer Fläche ziehen. Ein Doppelklick auf eine Kante zeigt das ganze Bild</translation>
    </message>
    <message>
        <source>Clipping plane</source>
        <translation>Schnittebene</translation>
    </message>
    <message>
        <source>drag its line</source>
        <translation>an ihrer Linie ziehen</translation>
    </message>
    <message>
        <source>By a disc near an end it turns within the slice</source>
        <translation>An einer Scheibe nahe dem Ende dreht sie sich in der Schicht</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::LandmarkModel</name>
    <message>
        <source>show it in the MR</source>
        <translation>im MR zeigen</translation>
    </message>
    <message>
        <source>%1 mm</source>
        <translation>%1 mm</translation>
    </message>
    <message>
        <source>#</source>
        <translation>#</translation>
    </message>
    <message>
        <source>In the %1</source>
        <translation>Im %1</translation>
    </message>
    <message>
        <source>In the MR</source>
        <translation>Im MR</translation>
    </message>
    <message>
        <source>Apart</source>
        <translation>Abstand</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::LandmarksBox</name>
    <message>
        <source>Pairs of points</source>
        <translation>Punktepaare</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>The pair that is chosen</source>
        <translation>Das gewählte Paar</translation>
    </message>
    <message>
        <source>Lay by points</source>
        <translation>Nach Punkten legen</translation>
    </message>
    <message>
        <source>Lays the MR so that the pairs fall on each other; three at least</source>
        <translation>Legt das MR so, dass die Paare aufeinanderfallen; mindestens drei</translation>
    </message>
    <message>
        <source>Point in MR (K)</source>
        <translation>Punkt im MR (K)</translation>
    </message>
    <message>
        <source>Point in %1 (K)</source>
        <translation>Punkt im %1 (K)</translation>
    </message>
    <message>
        <source>The crosshair marks a point of the %1, then the same point of the MR (K)</source>
        <translation>Das Fadenkreuz markiert einen Punkt des %1, dann denselben Punkt des MR (K)</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::LibraryController</name>
    <message>
        <source>%1 MB</source>
        <translation>%1 MB</translation>
    </message>
    <message>
        <source>    needed by: %1</source>
        <translation>    gebraucht von: %1</translation>
    </message>
    <message>
        <source>no case</source>
        <translation>kein Fall</translation>
    </message>
    <message>
        <source>    and by deleted cases: %1</source>
        <translation>    und von gelöschten Fällen: %1</translation>
    </message>
    <message>
        <source>&amp;Library</source>
        <translation>B&amp;ibliothek</translation>
    </message>
    <message>
        <source>&amp;Cases</source>
        <translation>&amp;Fälle</translation>
    </message>
    <message>
        <source>The list of all cases</source>
        <translation>Die Liste aller Fälle</translation>
    </message>
    <message>
        <source>&amp;Draw pictures</source>
        <translation>&amp;Bilder zeichnen</translation>
    </message>
    <message>
        <source>The small pictures in the list are drawn when a case is saved, and where one is missing, while nothing else goes on</source>
        <translation>Die kleinen Bilder der Liste werden gezeichnet, wenn ein Fall gespeichert wird, und wo eines fehlt, während nichts anderes läuft</translation>
    </message>
    <message>
        <source>&amp;Verify…</source>
        <translation>&amp;Prüfen…</translation>
    </message>
    <message>
        <source>Reads every file of the library and compares it with what was stored</source>
        <translation>Liest jede Datei der Bibliothek und vergleicht sie mit dem, was abgelegt wurde</translation>
    </message>
    <message>
        <source>Re&amp;pair…</source>
        <translation>&amp;Reparieren…</translation>
    </message>
    <message>
        <source>Recovers strokes that were not saved, and makes the list of cases anew from their files</source>
        <translation>Gewinnt nicht gespeicherte Bohrzüge wieder und baut die Liste der Fälle neu aus ihren Dateien auf</translation>
    </message>
    <message>
        <source>Clean &amp;up…</source>
        <translation>&amp;Aufräumen…</translation>
    </message>
    <message>
        <source>Removes deleted cases for good, and all that no case needs</source>
        <translation>Entfernt gelöschte Fälle endgültig und alles, was kein Fall braucht</translation>
    </message>
    <message>
        <source>Bringing back %1</source>
        <translation>%1 wird zurückgeholt</translation>
    </message>
    <message>
        <source>Rename the case</source>
        <translation>Fall umbenennen</translation>
    </message>
    <message>
        <source>New name of “%1”:</source>
        <translation>Neuer Name von „%1“:</translation>
    </message>
    <message>
        <source>Renaming %1</source>
        <translation>%1 wird umbenannt</translation>
    </message>
    <message>
        <source>Copy the case</source>
        <translation>Fall kopieren</translation>
    </message>
    <message>
        <source>Name of the copy of “%1”:</source>
        <translation>Name der Kopie von „%1“:</translation>
    </message>
    <message>
        <source>Copying %1</source>
        <translation>%1 wird kopiert</translation>
    </message>
    <message>
        <source>Delete the case</source>
        <translation>Fall löschen</translation>
    </message>
    <message>
        <source>Delete the case “%1”?</source>
        <translation>Den Fall „%1“ löschen?</translation>
    </message>
    <message>
        <source>%1 strokes were drilled in it. </source>
        <translation>%1 Bohrzüge wurden in ihm gebohrt. </translation>
    </message>
    <message>
        <source>It can be brought back (Bring back, below the list) until the library is cleaned up.</source>
        <translation>Er lässt sich zurückholen (Zurückholen, unter der Liste), bis die Bibliothek aufgeräumt wird.</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Löschen</translation>
    </message>
    <message>
        <source>Deleting %1</source>
        <translation>%1 wird gelöscht</translation>
    </message>
    <message>
        <source>Reading %1</source>
        <translation>%1 wird gelesen</translation>
    </message>
    <message>
        <source>Describing %1</source>
        <translation>%1 wird beschrieben</translation>
    </message>
    <message>
        <source>Making the picture of %1</source>
        <translation>Das Bild von %1 wird erstellt</translation>
    </message>
    <message>
        <source>The picture of %1 is made</source>
        <translation>Das Bild von %1 ist erstellt</translation>
    </message>
    <message>
        <source>No picture was made: it would show neither bone nor a structure</source>
        <translation>Es wurde kein Bild erstellt: Es würde weder Knochen noch eine Struktur zeigen</translation>
    </message>
    <message>
        <source>Verifying the library</source>
        <translation>Die Bibliothek wird geprüft</translation>
    </message>
    <message>
        <source>%1 cases and %2 files were read.</source>
        <translation>%1 Fälle und %2 Dateien wurden gelesen.</translation>
    </message>
    <message>
        <source>Verify</source>
        <translation>Prüfen</translation>
    </message>
    <message>
        <source>All are sound.</source>
        <translation>Alle sind heil.</translation>
    </message>
    <message>
        <source>1 is damaged or missing.</source>
        <translation>1 ist beschädigt oder fehlt.</translation>
    </message>
    <message>
        <source>%1 are damaged or missing.</source>
        <translation>%1 sind beschädigt oder fehlen.</translation>
    </message>
    <message>
        <source>Restore from a copy of the library, or import the data again.</source>
        <translation>Stellen Sie aus einer Kopie der Bibliothek wieder her oder importieren Sie die Daten erneut.</translation>
    </message>
    <message>
        <source>Clean up</source>
        <translation>Aufräumen</translation>
    </message>
    <message>
        <source>Remove all that no case needs?</source>
        <translation>Alles entfernen, was kein Fall braucht?</translation>
    </message>
    <message>
        <source>Remove the deleted case for good, and all that no case needs?</source>
        <translation>Den gelöschten Fall endgültig entfernen und alles, was kein Fall braucht?</translation>
    </message>
    <message>
        <source>Remove %1 deleted cases for good, and all that no case needs?</source>
        <translation>%1 gelöschte Fälle endgültig entfernen und alles, was kein Fall braucht?</translation>
    </message>
    <message>
        <source>They cannot be brought back afterwards. Data that were derived from images are computed anew when they are needed.</source>
        <translation>Danach lassen sie sich nicht zurückholen. Aus Bildern abgeleitete Daten werden neu berechnet, wenn sie gebraucht werden.</translation>
    </message>
    <message>
        <source>What was taken out of the open case (“%1”) cannot be put back any more.</source>
        <translation>Was aus dem offenen Fall („%1“) genommen wurde, lässt sich dann nicht mehr zurücklegen.</translation>
    </message>
    <message>
        <source>Cleaning up the library</source>
        <translation>Die Bibliothek wird aufgeräumt</translation>
    </message>
    <message>
        <source>Repairing the library</source>
        <translation>Die Bibliothek wird repariert</translation>
    </message>
    <message>
        <source>Library &gt; Verify tells whether files are damaged.</source>
        <translation>Bibliothek &gt; Prüfen sagt, ob Dateien beschädigt sind.</translation>
    </message>
    <message>
        <source>Repair</source>
        <translation>Reparieren</translation>
    </message>
    <message>
        <source>The library is repaired.</source>
        <translation>Die Bibliothek ist repariert.</translation>
    </message>
    <message>
        <source>What could be repaired is; what cases need is missing.</source>
        <translation>Was sich reparieren ließ, ist repariert; was Fälle brauchen, fehlt.</translation>
    </message>
    <message>
        <source>The case is not saved yet, so it was not copied</source>
        <translation>Der Fall ist noch nicht gespeichert und wurde deshalb nicht kopiert</translation>
    </message>
    <message>
        <source>Side</source>
        <translation>Seite</translation>
    </message>
    <message>
        <source>Written by a newer version of Petrous, and left alone: %1.</source>
        <translation>Von einer neueren Version von Petrous geschrieben und unberührt gelassen: %1.</translation>
    </message>
    <message>
        <source>All others are sound.</source>
        <translation>Alle anderen sind heil.</translation>
    </message>
    <message>
        <source>Cleaned up: %1 and %2 are gone, %3 are free again</source>
        <translation>Aufgeräumt: %1 und %2 sind weg, %3 sind wieder frei</translation>
    </message>
    <message>
        <source>1 deleted case</source>
        <translation>1 gelöschter Fall</translation>
    </message>
    <message>
        <source>%1 deleted cases</source>
        <translation>%1 gelöschte Fälle</translation>
    </message>
    <message>
        <source>1 file</source>
        <translation>1 Datei</translation>
    </message>
    <message>
        <source>%1 files</source>
        <translation>%1 Dateien</translation>
    </message>
    <message>
        <source>    file: %1</source>
        <translation>    Datei: %1</translation>
    </message>
    <message>
        <source>The case is called “%1”. A node to which it was sent keeps it as it was; sent again, it is another patient and study there.</source>
        <translation>Der Fall heißt „%1“. Ein Knoten, an den er gesendet wurde, behält ihn, wie er war; erneut gesendet, ist er dort ein anderer Patient und eine andere Studie.</translation>
    </message>
    <message>
        <source>1 stroke was drilled in it. </source>
        <translation>In ihm wurde 1 Bohrzug gebohrt. </translation>
    </message>
</context>
<context>
    <name>petrous::workstation::LibraryPanel</name>
    <message>
        <source>in &amp;notes too</source>
        <translation>auch in &amp;Notizen</translation>
    </message>
    <message>
        <source>&amp;planned from</source>
        <translation>ge&amp;plant ab</translation>
    </message>
    <message>
        <source>Search names, structures, tags, diagnoses</source>
        <translation>Name, Struktur, Schlagwort, Diagnose</translation>
    </message>
    <message>
        <source>Cases that have each of these words in their name or in that of a structure, MR or mesh, in a tag, the diagnosis or the procedure (%1)</source>
        <translation>Fälle, die jedes dieser Wörter in ihrem Namen oder dem einer Struktur, eines MR oder Netzes, in einem Schlagwort, der Diagnose oder dem Eingriff haben (%1)</translation>
    </message>
    <message>
        <source>Search cases</source>
        <translation>Fälle suchen</translation>
    </message>
    <message>
        <source>Cases of the library</source>
        <translation>Fälle der Bibliothek</translation>
    </message>
    <message>
        <source>Bring back</source>
        <translation>Zurückholen</translation>
    </message>
    <message>
        <source>Deleted cases, the last one first</source>
        <translation>Gelöschte Fälle, der letzte zuerst</translation>
    </message>
    <message>
        <source>Side</source>
        <translation>Seite</translation>
    </message>
    <message>
        <source>any side</source>
        <translation>jede Seite</translation>
    </message>
    <message>
        <source>Tag</source>
        <translation>Schlagwort</translation>
    </message>
    <message>
        <source>any tag</source>
        <translation>jedes Schlagwort</translation>
    </message>
    <message>
        <source>Cases whose planned date lies between these days, both included</source>
        <translation>Fälle, deren geplantes Datum zwischen diesen Tagen liegt, beide eingeschlossen</translation>
    </message>
    <message>
        <source>Planned from</source>
        <translation>Geplant ab</translation>
    </message>
    <message>
        <source>Planned to</source>
        <translation>Geplant bis</translation>
    </message>
    <message>
        <source>to</source>
        <translation>bis</translation>
    </message>
    <message>
        <source>&amp;Open</source>
        <translation>Ö&amp;ffnen</translation>
    </message>
    <message>
        <source>Opens the case</source>
        <translation>Öffnet den Fall</translation>
    </message>
    <message>
        <source>&amp;Rename…</source>
        <translation>&amp;Umbenennen…</translation>
    </message>
    <message>
        <source>Gives the case another name</source>
        <translation>Gibt dem Fall einen anderen Namen</translation>
    </message>
    <message>
        <source>&amp;Copy…</source>
        <translation>&amp;Kopieren…</translation>
    </message>
    <message>
        <source>A second case that begins as this one</source>
        <translation>Ein zweiter Fall, der wie dieser beginnt</translation>
    </message>
    <message>
        <source>&amp;Delete…</source>
        <translation>&amp;Löschen…</translation>
    </message>
    <message>
        <source>Takes the case out of the library; it can be brought back</source>
        <translation>Nimmt den Fall aus der Bibliothek; er lässt sich zurückholen</translation>
    </message>
    <message>
        <source>D&amp;escribe…</source>
        <translation>&amp;Beschreiben…</translation>
    </message>
    <message>
        <source>Note, tags, diagnosis, procedure, side, planned date</source>
        <translation>Notiz, Schlagwörter, Diagnose, Eingriff, Seite, geplantes Datum</translation>
    </message>
    <message>
        <source>Make the &amp;picture</source>
        <translation>B&amp;ild erstellen</translation>
    </message>
    <message>
        <source>The small picture in this list, from the last view</source>
        <translation>Das kleine Bild in dieser Liste, aus der letzten Ansicht</translation>
    </message>
    <message>
        <source>&amp;Archive the case…</source>
        <translation>Fall &amp;archivieren…</translation>
    </message>
    <message>
        <source>The case in one file</source>
        <translation>Der Fall in einer Datei</translation>
    </message>
    <message>
        <source>&amp;Send the case…</source>
        <translation>Fall &amp;senden…</translation>
    </message>
    <message>
        <source>The case to a DICOM node</source>
        <translation>Der Fall an einen DICOM-Knoten</translation>
    </message>
    <message>
        <source>1 case</source>
        <translation>1 Fall</translation>
    </message>
    <message>
        <source>%1 cases</source>
        <translation>%1 Fälle</translation>
    </message>
    <message>
        <source>No case yet. Drop a DICOM folder, or an archive (.petrous), on the window.</source>
        <translation>Noch kein Fall. Ziehen Sie einen DICOM-Ordner oder ein Archiv (.petrous) auf das Fenster.</translation>
    </message>
    <message>
        <source>No case has all of that.</source>
        <translation>Kein Fall hat all das.</translation>
    </message>
    <message>
        <source>%1, deleted %2</source>
        <translation>%1, gelöscht %2</translation>
    </message>
    <message>
        <source>Cases whose operation is on this side</source>
        <translation>Fälle, deren Operation auf dieser Seite ist</translation>
    </message>
    <message>
        <source>Cases that bear this tag</source>
        <translation>Fälle mit diesem Schlagwort</translation>
    </message>
    <message>
        <source>The search reads the notes of the cases, too</source>
        <translation>Die Suche liest auch die Notizen der Fälle</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Mehr</translation>
    </message>
    <message>
        <source>Archives, DICOM nodes, and the check of the library&apos;s files</source>
        <translation>Archive, DICOM-Knoten und die Prüfung der Dateien der Bibliothek</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::MainWindow</name>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Registration (F5)</source>
        <translation>Registrierung (F5)</translation>
    </message>
    <message>
        <source>What was drilled so far</source>
        <translation>Was bisher gebohrt wurde</translation>
    </message>
    <message>
        <source>Why the tool gives no force, or less than it would</source>
        <translation>Warum das Werkzeug keine Kraft gibt oder weniger, als es würde</translation>
    </message>
    <message>
        <source>Tool put away: what was drawn on the MR moved</source>
        <translation>Werkzeug weggelegt: Worauf im MR gezeichnet wurde, hat sich bewegt</translation>
    </message>
    <message>
        <source>The manual is in the browser</source>
        <translation>Das Handbuch ist im Browser</translation>
    </message>
    <message>
        <source>About Petrous</source>
        <translation>Über Petrous</translation>
    </message>
    <message>
        <source>The drill is off while a segment tool is in use; Esc puts that away</source>
        <translation>Der Bohrer ist aus, solange ein Segmentierwerkzeug benutzt wird; Esc legt es weg</translation>
    </message>
    <message>
        <source>Open a case first</source>
        <translation>Öffnen Sie zuerst einen Fall</translation>
    </message>
    <message>
        <source>Nothing was changed</source>
        <translation>Nichts wurde geändert</translation>
    </message>
    <message>
        <source>Nothing was undone</source>
        <translation>Nichts wurde rückgängig gemacht</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Rückgängig</translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation>&amp;Wiederholen</translation>
    </message>
    <message>
        <source>Undone: %1</source>
        <translation>Rückgängig: %1</translation>
    </message>
    <message>
        <source>Done again: %1</source>
        <translation>Wiederholt: %1</translation>
    </message>
    <message>
        <source>Something failed: %1 Save the case; if this comes again, start Petrous anew.</source>
        <translation>Etwas ist fehlgeschlagen: %1 Speichern Sie den Fall; kommt dies wieder, starten Sie Petrous neu.</translation>
    </message>
    <message>
        <source>“%1”</source>
        <translation>„%1“</translation>
    </message>
    <message>
        <source>The case has the MR %1, which is not registered with the %2 and not shown yet. Registration &gt; Register the MR (Ctrl+R) registers it.</source>
        <translation>Der Fall hat das MR %1, das nicht mit dem %2 registriert ist und noch nicht gezeigt wird. Registrierung &gt; MR registrieren (Strg+R) registriert es.</translation>
    </message>
    <message>
        <source>The case has the MRs %1, which are not registered with the %2 and not shown yet. Registration &gt; Register the MR (Ctrl+R) registers them.</source>
        <translation>Der Fall hat die MRs %1, die nicht mit dem %2 registriert sind und noch nicht gezeigt werden. Registrierung &gt; MR registrieren (Strg+R) registriert sie.</translation>
    </message>
    <message>
        <source>Petrous (safe mode)</source>
        <translation>Petrous (abgesicherter Modus)</translation>
    </message>
    <message>
        <source>Stroke %1 undone</source>
        <translation>Bohrzug %1 rückgängig</translation>
    </message>
    <message>
        <source>Stroke %1 drilled again</source>
        <translation>Bohrzug %1 erneut gebohrt</translation>
    </message>
    <message>
        <source>Nothing was taken out of the case</source>
        <translation>Nichts wurde aus dem Fall genommen</translation>
    </message>
    <message>
        <source>Put &amp;back</source>
        <translation>Zurü&amp;cklegen</translation>
    </message>
    <message>
        <source>Put &amp;back “%1”</source>
        <translation>„%1“ zurü&amp;cklegen</translation>
    </message>
    <message>
        <source>Rename the MR “%1”…</source>
        <translation>MR „%1“ umbenennen…</translation>
    </message>
    <message>
        <source>Remove the MR “%1”</source>
        <translation>MR „%1“ entfernen</translation>
    </message>
    <message>
        <source>Record the session</source>
        <translation>Sitzung aufzeichnen</translation>
    </message>
    <message>
        <source>Recordings (*.ticks)</source>
        <translation>Aufzeichnungen (*.ticks)</translation>
    </message>
    <message>
        <source>Recording %1</source>
        <translation>%1 wird aufgezeichnet</translation>
    </message>
    <message>
        <source>All that tool and drill do is written to %1, until Drill &gt; Record session… is chosen again</source>
        <translation>Alles, was Werkzeug und Bohrer tun, wird in %1 geschrieben, bis Bohren &gt; Sitzung aufzeichnen… erneut gewählt wird</translation>
    </message>
    <message>
        <source>%1 Drilling goes on.</source>
        <translation>%1 Das Bohren geht weiter.</translation>
    </message>
    <message>
        <source>Note on the case</source>
        <translation>Hinweis zum Fall</translation>
    </message>
    <message>
        <source>Materials and burrs</source>
        <translation>Materialien und Fräsen</translation>
    </message>
    <message>
        <source>Begin with the built-in tables in place of what cannot be read? The file stays as it is until you save, which replaces or removes it.</source>
        <translation>Mit den eingebauten Tabellen an Stelle dessen beginnen, was nicht gelesen werden kann? Die Datei bleibt, wie sie ist, bis Sie speichern; das ersetzt oder entfernt sie.</translation>
    </message>
    <message>
        <source>Begin with the &amp;built-in tables</source>
        <translation>Mit den ein&amp;gebauten Tabellen beginnen</translation>
    </message>
    <message>
        <source>Instrument from a file</source>
        <translation>Instrument aus einer Datei</translation>
    </message>
    <message>
        <source>Choose a &amp;file…</source>
        <translation>&amp;Datei wählen…</translation>
    </message>
    <message>
        <source>An instrument is in the hand, not the burr</source>
        <translation>In der Hand ist ein Instrument, nicht die Fräse</translation>
    </message>
    <message>
        <source>Rename “%1”…</source>
        <translation>„%1“ umbenennen…</translation>
    </message>
    <message>
        <source>Remove “%1”</source>
        <translation>„%1“ entfernen</translation>
    </message>
    <message>
        <source>Remove the %1 selected</source>
        <translation>Die %1 ausgewählten entfernen</translation>
    </message>
    <message>
        <source>Takes what is selected in the list of structures out of the case; Ctrl+Z brings it back</source>
        <translation>Nimmt, was in der Liste der Strukturen ausgewählt ist, aus dem Fall; Strg+Z holt es zurück</translation>
    </message>
    <message>
        <source>It would move an MR while a registration is under way: wait for that, or cancel it</source>
        <translation>Das würde ein MR verschieben, während eine Registrierung läuft: sie abwarten oder abbrechen</translation>
    </message>
    <message>
        <source>The case keeps no instrument</source>
        <translation>Der Fall behält kein Instrument</translation>
    </message>
    <message>
        <source>reading the attachment “%1”</source>
        <translation>Lesen des Anhangs „%1“</translation>
    </message>
    <message>
        <source>Keep the case open</source>
        <translation>Fall offen lassen</translation>
    </message>
    <message>
        <source>%1 as soon as this is done: %2</source>
        <translation>%1, sobald dies fertig ist: %2</translation>
    </message>
    <message>
        <source>Which ear it is, is not known (Case &gt; Side): this is the patient&apos;s left</source>
        <translation>Welches Ohr es ist, ist nicht bekannt (Fall &gt; Seite): dies ist die linke Seite des Patienten</translation>
    </message>
    <message>
        <source>Which ear it is, is not known (Case &gt; Side): this is the patient&apos;s right</source>
        <translation>Welches Ohr es ist, ist nicht bekannt (Fall &gt; Seite): dies ist die rechte Seite des Patienten</translation>
    </message>
    <message>
        <source>Correct the axes of the MR “%1”…</source>
        <translation>Achsen des MR „%1“ korrigieren…</translation>
    </message>
    <message>
        <source>Correct the axes of “%1”…</source>
        <translation>Achsen von „%1“ korrigieren…</translation>
    </message>
    <message>
        <source>A structure or mesh of the case has this name, too, and would be taken out in its place; take that out first</source>
        <translation>Eine Struktur oder ein Netz des Falls hat auch diesen Namen und würde statt dessen aus dem Fall genommen; nehmen Sie sie zuerst heraus</translation>
    </message>
    <message>
        <source>%1 and %2 more: %3</source>
        <translation>%1 und %2 weitere: %3</translation>
    </message>
    <message>
        <source>Preparing the picture…</source>
        <translation>Das Bild wird vorbereitet…</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::MeasureController</name>
    <message>
        <source>&amp;Distance</source>
        <translation>&amp;Abstand</translation>
    </message>
    <message>
        <source>Between two points</source>
        <translation>Zwischen zwei Punkten</translation>
    </message>
    <message>
        <source>&amp;Angle</source>
        <translation>&amp;Winkel</translation>
    </message>
    <message>
        <source>At the second of three points</source>
        <translation>Am zweiten von drei Punkten</translation>
    </message>
    <message>
        <source>A&amp;rea</source>
        <translation>&amp;Fläche</translation>
    </message>
    <message>
        <source>Of a polygon; Return or a double click closes it</source>
        <translation>Eines Polygons; Eingabe oder Doppelklick schließt es</translation>
    </message>
    <message>
        <source>&amp;Mark</source>
        <translation>&amp;Marke</translation>
    </message>
    <message>
        <source>A place with a name</source>
        <translation>Ein Ort mit einem Namen</translation>
    </message>
    <message>
        <source>Along a &amp;structure</source>
        <translation>Entlang einer &amp;Struktur</translation>
    </message>
    <message>
        <source>Along the centre line of a nerve or canal between two points, or along points of your own</source>
        <translation>Entlang der Mittellinie eines Nervs oder Kanals zwischen zwei Punkten oder entlang eigener Punkte</translation>
    </message>
    <message>
        <source>&amp;Wall thickness</source>
        <translation>Wand&amp;dicke</translation>
    </message>
    <message>
        <source>Of the bone at a point of its surface, to the next structure or cavity</source>
        <translation>Des Knochens an einem Punkt seiner Oberfläche, bis zur nächsten Struktur oder Höhle</translation>
    </message>
    <message>
        <source>&amp;Measure</source>
        <translation>&amp;Messen</translation>
    </message>
    <message>
        <source>Measuring: %1 %</source>
        <translation>Messung: %1 %</translation>
    </message>
    <message>
        <source>&amp;End the line or polygon</source>
        <translation>Linie oder Polygon be&amp;enden</translation>
    </message>
    <message>
        <source>With the points that are set (Return, or a double click)</source>
        <translation>Mit den gesetzten Punkten (Eingabe oder Doppelklick)</translation>
    </message>
    <message>
        <source>Show a&amp;ll</source>
        <translation>Alle &amp;zeigen</translation>
    </message>
    <message>
        <source>All measurements, in the slices and in 3D</source>
        <translation>Alle Messungen, in den Schichten und in 3D</translation>
    </message>
    <message>
        <source>&amp;Hide all</source>
        <translation>Alle a&amp;usblenden</translation>
    </message>
    <message>
        <source>The list keeps them</source>
        <translation>Die Liste behält sie</translation>
    </message>
    <message>
        <source>E&amp;xport as a table…</source>
        <translation>Als &amp;Tabelle exportieren…</translation>
    </message>
    <message>
        <source>All measurements and the volumes of structures, as CSV</source>
        <translation>Alle Messungen und die Volumina von Strukturen, als CSV</translation>
    </message>
    <message>
        <source>The slices show the mean of a slab: the point lies in its middle, whatever depth is seen there</source>
        <translation>Die Schichten zeigen das Mittel eines Schichtpakets: Der Punkt liegt in dessen Mitte, welche Tiefe dort auch zu sehen ist</translation>
    </message>
    <message>
        <source>The measurement is on the clipboard</source>
        <translation>Die Messung ist in der Zwischenablage</translation>
    </message>
    <message>
        <source>%1 measurements are on the clipboard</source>
        <translation>%1 Messungen sind in der Zwischenablage</translation>
    </message>
    <message>
        <source>Export measurements</source>
        <translation>Messungen exportieren</translation>
    </message>
    <message>
        <source>Tables (*.csv)</source>
        <translation>Tabellen (*.csv)</translation>
    </message>
    <message>
        <source>measurements</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>The measurements are in %1</source>
        <translation>Die Messungen sind in %1</translation>
    </message>
    <message>
        <source>The structures are still being loaded.</source>
        <translation>Die Strukturen werden noch geladen.</translation>
    </message>
    <message>
        <source>There is nothing under the pointer.</source>
        <translation>Unter dem Mauszeiger ist nichts.</translation>
    </message>
    <message>
        <source>The case is still being prepared; then the surface can be clicked. The slices can be already.</source>
        <translation>Der Fall wird noch vorbereitet; dann kann die Oberfläche angeklickt werden. Bei den Schichten geht es schon.</translation>
    </message>
    <message>
        <source>The points that were set are dropped: they do not make a measurement</source>
        <translation>Die gesetzten Punkte sind verworfen: Sie ergeben keine Messung</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::MeasurePanel</name>
    <message>
        <source>Mark</source>
        <translation>Marke</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>Length along a line</source>
        <translation>Länge entlang einer Linie</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>Area</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>Wall thickness</source>
        <translation>Wanddicke</translation>
    </message>
    <message>
        <source>Nothing is measured yet.</source>
        <translation>Noch ist nichts gemessen.</translation>
    </message>
    <message>
        <source>The structure that is measured</source>
        <translation>Die Struktur, die gemessen wird</translation>
    </message>
    <message>
        <source>Its dimensions, or the shortest distance from its surface to that of another one</source>
        <translation>Ihre Maße oder der kürzeste Abstand von ihrer Oberfläche zu der einer anderen</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>&amp;Go to</source>
        <translation>&amp;Gehe zu</translation>
    </message>
    <message>
        <source>The slices show it (Enter)</source>
        <translation>Die Schichten zeigen es (Eingabe)</translation>
    </message>
    <message>
        <source>&amp;Rename</source>
        <translation>&amp;Umbenennen</translation>
    </message>
    <message>
        <source>Type another name (F2)</source>
        <translation>Einen anderen Namen tippen (F2)</translation>
    </message>
    <message>
        <source>&amp;Delete</source>
        <translation>&amp;Löschen</translation>
    </message>
    <message>
        <source>Ctrl+Z brings it back (Del)</source>
        <translation>Strg+Z holt es zurück (Entf)</translation>
    </message>
    <message>
        <source>Cop&amp;y</source>
        <translation>&amp;Kopieren</translation>
    </message>
    <message>
        <source>Names and values, to be pasted elsewhere: of the chosen one, or of all</source>
        <translation>Namen und Werte, um sie anderswo einzufügen: der gewählten oder aller</translation>
    </message>
    <message>
        <source>E&amp;xport…</source>
        <translation>E&amp;xportieren…</translation>
    </message>
    <message>
        <source>A table (CSV) of all measurements and of the volumes of structures</source>
        <translation>Eine Tabelle (CSV) aller Messungen und der Volumina von Strukturen</translation>
    </message>
    <message>
        <source>&amp;Measure</source>
        <translation>&amp;Messen</translation>
    </message>
    <message>
        <source>Volume, extents along the principal axes, and of a canal or nerve length and diameters; or the distance</source>
        <translation>Volumen, Ausdehnungen entlang der Hauptachsen und bei einem Kanal oder Nerv Länge und Durchmesser; oder der Abstand</translation>
    </message>
    <message>
        <source>Dimensions</source>
        <translation>Maße</translation>
    </message>
    <message>
        <source>&amp;Structure</source>
        <translation>&amp;Struktur</translation>
    </message>
    <message>
        <source>&amp;What</source>
        <translation>&amp;Was</translation>
    </message>
    <message>
        <source>dimensions and volume</source>
        <translation>Maße und Volumen</translation>
    </message>
    <message>
        <source>distance to %1</source>
        <translation>Abstand zu %1</translation>
    </message>
    <message>
        <source>Choose a tool, then click in the slices or on the surface in the 3D view. Points can be dragged.</source>
        <translation>Wählen Sie ein Werkzeug, dann klicken Sie in die Schichten oder auf die Oberfläche in der 3D-Ansicht. Punkte lassen sich ziehen.</translation>
    </message>
    <message>
        <source>Esc puts the tool away.</source>
        <translation>Esc legt das Werkzeug weg.</translation>
    </message>
    <message>
        <source>Measuring…</source>
        <translation>Messung läuft…</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::MetricCurve</name>
    <message>
        <source>Metric while the registration runs</source>
        <translation>Metrik, während die Registrierung läuft</translation>
    </message>
    <message>
        <source>level %1, metric %2</source>
        <translation>Stufe %1, Metrik %2</translation>
    </message>
    <message>
        <source>Mutual information while the registration runs, nats; within a level, higher is better. A vertical line and a number: the next finer level, with a scale of its own. Values of two levels are not comparable: on finer images it is lower</source>
        <translation>Transinformation, während die Registrierung läuft, in nat; innerhalb einer Stufe ist höher besser. Eine senkrechte Linie und eine Zahl: die nächste feinere Stufe mit eigener Skala. Werte zweier Stufen sind nicht vergleichbar: Auf feineren Bildern ist sie niedriger</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::MrOverlay</name>
    <message>
        <source>%1 alone (V)</source>
        <translation>%1 allein (V)</translation>
    </message>
    <message>
        <source>: being registered</source>
        <translation>: wird registriert</translation>
    </message>
    <message>
        <source>: not registered</source>
        <translation>: nicht registriert</translation>
    </message>
    <message>
        <source>: %1</source>
        <translation>: %1</translation>
    </message>
    <message>
        <source>%1: being read…</source>
        <translation>%1: wird gelesen…</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::NearbyModel</name>
    <message>
        <source>%1 mm ± %2</source>
        <translation>%1 mm ± %2</translation>
    </message>
    <message>
        <source>touched</source>
        <translation>berührt</translation>
    </message>
    <message>
        <source>within %1 mm</source>
        <translation>innerhalb von %1 mm</translation>
    </message>
    <message>
        <source>open</source>
        <translation>eröffnet</translation>
    </message>
    <message>
        <source>injured, %1 taken</source>
        <translation>verletzt, %1 abgetragen</translation>
    </message>
    <message>
        <source>registration&apos;s error unknown</source>
        <translation>Fehler der Registrierung unbekannt</translation>
    </message>
    <message>
        <source>clear</source>
        <translation>frei</translation>
    </message>
    <message>
        <source>%1: %2
Its surface is known to ±%3 mm: %4</source>
        <translation>%1: %2
Seine Oberfläche ist auf ±%3 mm bekannt: %4</translation>
    </message>
    <message>
        <source>Structure</source>
        <translation>Struktur</translation>
    </message>
    <message>
        <source>The nearest first</source>
        <translation>Die nächste zuerst</translation>
    </message>
    <message>
        <source>maybe within %1 mm</source>
        <translation>vielleicht innerhalb von %1 mm</translation>
    </message>
    <message>
        <source>
The instrument is measured at points: between them it may be %1 mm nearer</source>
        <translation>
Das Instrument wird an Punkten gemessen: Dazwischen kann es %1 mm näher sein</translation>
    </message>
    <message>
        <source>From the tool</source>
        <translation>Vom Werkzeug</translation>
    </message>
    <message>
        <source>From the burr&apos;s ball, or the instrument, to the structure&apos;s surface, and how well that is known to either side</source>
        <translation>Von der Kugel der Fräse oder vom Instrument zur Oberfläche der Struktur und wie genau diese nach beiden Seiten bekannt ist</translation>
    </message>
    <message>
        <source>Whether the tool is within the warning distance, and what was taken</source>
        <translation>Ob das Werkzeug im Warnabstand ist und was abgetragen wurde</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::NearbyPanel</name>
    <message>
        <source>Removed: %1 mm³ in %2 %3</source>
        <translation>Abgetragen: %1 mm³ in %2 %3</translation>
    </message>
    <message>
        <source>stroke</source>
        <translation>Bohrzug</translation>
    </message>
    <message>
        <source>strokes</source>
        <translation>Bohrzügen</translation>
    </message>
    <message>
        <source>
Injured: %1, %2</source>
        <translation>
Verletzt: %1, %2</translation>
    </message>
    <message>
        <source>Measuring the structures…</source>
        <translation>Die Strukturen werden vermessen…</translation>
    </message>
    <message>
        <source>No structure that is shown lies within %1 mm of the burr</source>
        <translation>Keine gezeigte Struktur liegt innerhalb von %1 mm um die Fräse</translation>
    </message>
    <message>
        <source>The structures cannot be measured: %1</source>
        <translation>Die Strukturen lassen sich nicht vermessen: %1</translation>
    </message>
    <message>
        <source>No structure that is shown lies within %1 mm of the instrument</source>
        <translation>Keine gezeigte Struktur liegt innerhalb von %1 mm um das Instrument</translation>
    </message>
    <message>
        <source>Take up the burr (D) or an instrument to see how far the structures are from it</source>
        <translation>Nehmen Sie die Fräse (D) oder ein Instrument auf, um zu sehen, wie weit die Strukturen entfernt sind</translation>
    </message>
    <message>
        <source>Structures near the tool</source>
        <translation>Strukturen nahe am Werkzeug</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::NodesDialog</name>
    <message>
        <source>Your name for the node</source>
        <translation>Ihr Name für den Knoten</translation>
    </message>
    <message>
        <source>Name or IPv4 address of the computer, without a port</source>
        <translation>Name oder IPv4-Adresse des Rechners, ohne Port</translation>
    </message>
    <message>
        <source>By which the node is called: 1 to 16 characters. Whoever runs the node knows it</source>
        <translation>Womit der Knoten angerufen wird: 1 bis 16 Zeichen. Wer den Knoten betreibt, kennt es</translation>
    </message>
    <message>
        <source>By which the node knows this computer: it has to be entered there</source>
        <translation>Womit der Knoten diesen Rechner kennt: Es muss dort eingetragen sein</translation>
    </message>
    <message>
        <source>Name or IPv4 address of the computer from which the node sends by C-MOVE; * for any. Nobody else is let in</source>
        <translation>Name oder IPv4-Adresse des Rechners, von dem der Knoten mit C-MOVE sendet; * für jeden. Niemand sonst wird eingelassen</translation>
    </message>
    <message>
        <source>&amp;Encrypted (TLS 1.2 or later)</source>
        <translation>&amp;Verschlüsselt (TLS 1.2 oder neuer)</translation>
    </message>
    <message>
        <source>Name or IP address in the node&apos;s certificate, where it is not the host; * if any of the trusted certificates will do, as where the node&apos;s own is the only one</source>
        <translation>Name oder IP-Adresse im Zertifikat des Knotens, wo es nicht der Host ist; * wenn jedes der vertrauenswürdigen Zertifikate genügt, etwa weil das des Knotens das einzige ist</translation>
    </message>
    <message>
        <source>Certificates to trust</source>
        <translation>Vertrauenswürdige Zertifikate</translation>
    </message>
    <message>
        <source>Certificate of this computer</source>
        <translation>Zertifikat dieses Rechners</translation>
    </message>
    <message>
        <source>Key of that certificate</source>
        <translation>Schlüssel dieses Zertifikats</translation>
    </message>
    <message>
        <source>DICOM nodes</source>
        <translation>DICOM-Knoten</translation>
    </message>
    <message>
        <source>Stopped</source>
        <translation>Angehalten</translation>
    </message>
    <message>
        <source>Nodes</source>
        <translation>Knoten</translation>
    </message>
    <message>
        <source>The node&apos;s certificate is always verified, and must be of its host, or of the name below</source>
        <translation>Das Zertifikat des Knotens wird immer geprüft und muss auf seinen Host lauten oder auf den Namen unten</translation>
    </message>
    <message>
        <source>the host</source>
        <translation>der Host</translation>
    </message>
    <message>
        <source>not needed (C-GET)</source>
        <translation>nicht nötig (C-GET)</translation>
    </message>
    <message>
        <source>For a node without C-GET: the port at which this computer listens for what the node sends by C-MOVE. The node must know your AE title at this computer and port</source>
        <translation>Für einen Knoten ohne C-GET: der Port, an dem dieser Rechner auf das wartet, was der Knoten mit C-MOVE sendet. Der Knoten muss Ihren AE-Titel an diesem Rechner und Port kennen</translation>
    </message>
    <message>
        <source>those of the system</source>
        <translation>die des Systems</translation>
    </message>
    <message>
        <source>none; only if the node wants one</source>
        <translation>keines; nur auf Verlangen</translation>
    </message>
    <message>
        <source>PEM, without a passphrase</source>
        <translation>PEM, ohne Passphrase</translation>
    </message>
    <message>
        <source>&amp;Name:</source>
        <translation>&amp;Name:</translation>
    </message>
    <message>
        <source>&amp;Host:</source>
        <translation>&amp;Host:</translation>
    </message>
    <message>
        <source>&amp;Port:</source>
        <translation>&amp;Port:</translation>
    </message>
    <message>
        <source>&amp;AE title:</source>
        <translation>&amp;AE-Titel:</translation>
    </message>
    <message>
        <source>&amp;Your AE title:</source>
        <translation>&amp;Ihr AE-Titel:</translation>
    </message>
    <message>
        <source>Port for C-&amp;MOVE:</source>
        <translation>Port für C-&amp;MOVE:</translation>
    </message>
    <message>
        <source>C-MOVE &amp;from:</source>
        <translation>C-MOVE v&amp;on:</translation>
    </message>
    <message>
        <source>&amp;Trusted certificates:</source>
        <translation>Vertra&amp;uenswürdig:</translation>
    </message>
    <message>
        <source>Name &amp;in its certificate:</source>
        <translation>Name &amp;darin:</translation>
    </message>
    <message>
        <source>Your &amp;key:</source>
        <translation>Ihr &amp;Schlüssel:</translation>
    </message>
    <message>
        <source>A&amp;dd</source>
        <translation>Hinzu&amp;fügen</translation>
    </message>
    <message>
        <source>Keeps the node in the library, without any secret</source>
        <translation>Nimmt den Knoten in die Bibliothek auf, ohne jedes Geheimnis</translation>
    </message>
    <message>
        <source>Te&amp;st</source>
        <translation>&amp;Testen</translation>
    </message>
    <message>
        <source>Calls the node (C-ECHO), kept or not</source>
        <translation>Ruft den Knoten an (C-ECHO), ob er aufgenommen ist oder nicht</translation>
    </message>
    <message>
        <source>&amp;Remove</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>Takes the node out of the list</source>
        <translation>Nimmt den Knoten aus der Liste</translation>
    </message>
    <message>
        <source>at</source>
        <translation>bei</translation>
    </message>
    <message>
        <source>&amp;Change</source>
        <translation>Ände&amp;rn</translation>
    </message>
    <message>
        <source>&amp;Stop</source>
        <translation>Anha&amp;lten</translation>
    </message>
    <message>
        <source>“%1” is changed.</source>
        <translation>„%1“ ist geändert.</translation>
    </message>
    <message>
        <source>“%1” is kept. Test calls it.</source>
        <translation>„%1“ ist aufgenommen. Testen ruft ihn an.</translation>
    </message>
    <message>
        <source>“%1” answers, after %2 ms.</source>
        <translation>„%1“ antwortet nach %2 ms.</translation>
    </message>
    <message>
        <source>Calling “%1”…</source>
        <translation>„%1“ wird angerufen…</translation>
    </message>
    <message>
        <source>“%1” is removed. To take it back, press Add now.</source>
        <translation>„%1“ ist entfernt. Um ihn zurückzunehmen, drücken Sie jetzt Hinzufügen.</translation>
    </message>
    <message>
        <source>Y&amp;our certificate:</source>
        <translation>Ihr &amp;Zertifikat:</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::PathRow</name>
    <message>
        <source>Browse…</source>
        <translation>Durchsuchen…</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::PictureController</name>
    <message>
        <source>How many pictures a second can be drawn, and at what share of the full resolution while something moves</source>
        <translation>Wie viele Bilder je Sekunde gezeichnet werden können und mit welchem Anteil der vollen Auflösung, während sich etwas bewegt</translation>
    </message>
    <message>
        <source>%1 Hz</source>
        <translation>%1 Hz</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>%1 at %2 %</source>
        <translation>%1 bei %2 %</translation>
    </message>
    <message>
        <source>The 3D picture failed</source>
        <translation>Das 3D-Bild ist fehlgeschlagen</translation>
    </message>
    <message>
        <source>The case is saved. </source>
        <translation>Der Fall ist gespeichert. </translation>
    </message>
    <message>
        <source>The case could not be saved; save it first. </source>
        <translation>Der Fall konnte nicht gespeichert werden; speichern Sie ihn zuerst. </translation>
    </message>
    <message>
        <source>Close Petrous and start it again. If it fails again, close other programs that use the graphics card, load only the ear, or install a newer driver. The slices go on working.</source>
        <translation>Schließen Sie Petrous und starten Sie es erneut. Schlägt es wieder fehl, schließen Sie andere Programme, die die Grafikkarte benutzen, laden Sie nur das Ohr oder installieren Sie einen neueren Treiber. Die Schichten arbeiten weiter.</translation>
    </message>
    <message>
        <source>Soft tissue is left out while a tool is in the hand</source>
        <translation>Weichgewebe wird weggelassen, solange ein Werkzeug in der Hand ist</translation>
    </message>
    <message>
        <source>Preparing the picture…</source>
        <translation>Das Bild wird vorbereitet…</translation>
    </message>
    <message>
        <source>Soft tissue is not drawn: %1</source>
        <translation>Weichgewebe wird nicht gezeichnet: %1</translation>
    </message>
    <message>
        <source>The camera is inside tissue: zoom out</source>
        <translation>Die Kamera steht im Gewebe: herauszoomen</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::PicturePanel</name>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
    <message>
        <source>Below 100 % the inside of the bone and the structures in it shine through</source>
        <translation>Unter 100 % scheinen das Innere des Knochens und die Strukturen darin durch</translation>
    </message>
    <message>
        <source>&amp;Light falloff</source>
        <translation>&amp;Lichtabfall</translation>
    </message>
    <message>
        <source>Distance from the lamp, which sits at the microscope, at which its light is halved, mm</source>
        <translation>Abstand von der Lampe, die am Mikroskop sitzt, in dem ihr Licht halbiert ist, mm</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keiner</translation>
    </message>
    <message>
        <source>&amp;Wetness</source>
        <translation>&amp;Nässe</translation>
    </message>
    <message>
        <source>A film of water on tissue: thin highlights in place of its own gloss</source>
        <translation>Ein Wasserfilm auf dem Gewebe: schmale Glanzlichter anstelle seines eigenen Glanzes</translation>
    </message>
    <message>
        <source>How both eyes&apos; pictures come to one screen</source>
        <translation>Wie die Bilder beider Augen auf einen Bildschirm kommen</translation>
    </message>
    <message>
        <source>Off</source>
        <translation>Aus</translation>
    </message>
    <message>
        <source>Side by side</source>
        <translation>Nebeneinander</translation>
    </message>
    <message>
        <source>Line-interleaved</source>
        <translation>Zeilenweise</translation>
    </message>
    <message>
        <source>Anaglyph (red-cyan)</source>
        <translation>Anaglyph (rot-cyan)</translation>
    </message>
    <message>
        <source>Quad buffer (surgeon&apos;s window)</source>
        <translation>Quad-Buffer (Fenster des Chirurgen)</translation>
    </message>
    <message>
        <source>&amp;Stereo</source>
        <translation>&amp;Stereo</translation>
    </message>
    <message>
        <source>&amp;Eye separation</source>
        <translation>&amp;Augenabstand</translation>
    </message>
    <message>
        <source>Between the two eyes of the microscope, mm. Automatic: %1° between their lines of sight, as 24 mm at 250 mm</source>
        <translation>Zwischen den beiden Augen des Mikroskops, mm. Automatisch: %1° zwischen ihren Blickrichtungen, wie 24 mm bei 250 mm</translation>
    </message>
    <message>
        <source>automatic (%1°)</source>
        <translation>automatisch (%1°)</translation>
    </message>
    <message>
        <source>&amp;Convergence</source>
        <translation>&amp;Konvergenz</translation>
    </message>
    <message>
        <source>From the microscope to where both eyes see the same place on the screen, mm</source>
        <translation>Vom Mikroskop dorthin, wo beide Augen denselben Ort auf dem Bildschirm sehen, mm</translation>
    </message>
    <message>
        <source>centre of rotation</source>
        <translation>Drehpunkt</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>&amp;Tissue opacity</source>
        <translation>&amp;Gewebedeckkraft</translation>
    </message>
    <message>
        <source>&amp;Bone opacity</source>
        <translation>Knochen&amp;deckkraft</translation>
    </message>
    <message>
        <source>Below 100 % the inside of the tissue and the structures in it shine through</source>
        <translation>Unter 100 % scheinen das Innere des Gewebes und die Strukturen darin durch</translation>
    </message>
    <message>
        <source>&amp;Shadows</source>
        <translation>Sc&amp;hatten</translation>
    </message>
    <message>
        <source>Cavities are darker than what is open, and a lamp somewhat above the line of sight throws a soft shadow</source>
        <translation>Vertiefungen sind dunkler als das, was offen liegt, und eine Lampe etwas über der Blickrichtung wirft einen weichen Schatten</translation>
    </message>
    <message>
        <source>E&amp;xposure</source>
        <translation>&amp;Belichtung</translation>
    </message>
    <message>
        <source>Brightness of all that is lit, EV: one more doubles the luminance, one less halves it. 0 shows structures in the colours of their list</source>
        <translation>Helligkeit von allem, was beleuchtet ist, in EV: Eins mehr verdoppelt die Leuchtdichte, eins weniger halbiert sie. Bei 0 haben Strukturen die Farben ihrer Liste</translation>
    </message>
    <message>
        <source> EV</source>
        <translation> EV</translation>
    </message>
    <message>
        <source>Soft &amp;highlights</source>
        <translation>&amp;Weiche Glanzlichter</translation>
    </message>
    <message>
        <source>So&amp;ft tissue</source>
        <translation>Weich&amp;gewebe</translation>
    </message>
    <message>
        <source>Skin, fat and muscle are drawn, translucent: what is neither bone nor a structure. The Appearance panel has their colours and opacities</source>
        <translation>Haut, Fett und Muskeln werden durchscheinend gezeichnet: was weder Knochen noch eine Struktur ist. Farben und Deckkräfte stehen im Bereich Darstellung</translation>
    </message>
    <message>
        <source>Not drawn: %1</source>
        <translation>Nicht gezeichnet: %1</translation>
    </message>
    <message>
        <source>What is brighter than 80 % rolls off towards white instead of burning out; bright colours of structures become a little darker than in their list</source>
        <translation>Was heller als 80 % ist, geht sanft in Weiß über, statt auszubrennen; helle Farben von Strukturen werden etwas dunkler als in ihrer Liste</translation>
    </message>
    <message>
        <source>What lies below the surface threshold and is no structure is drawn, translucent. The Appearance panel has its colours and opacities</source>
        <translation>Was unter der Oberflächenschwelle liegt und keine Struktur ist, wird durchscheinend gezeichnet. Farben und Deckkräfte stehen im Bereich Darstellung</translation>
    </message>
    <message>
        <source>Ed&amp;ges</source>
        <translation>Kant&amp;en</translation>
    </message>
    <message>
        <source>Translucent surfaces are more opaque where they are seen from the side, as a shell is, so that they keep their shape</source>
        <translation>Durchscheinende Oberflächen sind dort, wo man sie von der Seite sieht, deckender, wie eine Schale, sodass sie ihre Form behalten</translation>
    </message>
    <message>
        <source>Of the 3D view: what is beside the patient. The slices stay black, and the patient as bright as before</source>
        <translation>Der 3D-Ansicht: was neben dem Patienten zu sehen ist. Die Schichten bleiben schwarz, und der Patient so hell wie vorher</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Schwarz</translation>
    </message>
    <message>
        <source>Dark grey</source>
        <translation>Dunkelgrau</translation>
    </message>
    <message>
        <source>Light grey</source>
        <translation>Hellgrau</translation>
    </message>
    <message>
        <source>White</source>
        <translation>Weiß</translation>
    </message>
    <message>
        <source>Other colour…</source>
        <translation>Andere Farbe…</translation>
    </message>
    <message>
        <source>Background of the 3D view</source>
        <translation>Hintergrund der 3D-Ansicht</translation>
    </message>
    <message>
        <source>Bac&amp;kground</source>
        <translation>Hinte&amp;rgrund</translation>
    </message>
    <message>
        <source>Other colour</source>
        <translation>Andere Farbe</translation>
    </message>
    <message>
        <source>Any colour, of a dialog</source>
        <translation>Eine beliebige Farbe, aus einem Dialog</translation>
    </message>
    <message>
        <source>Grai&amp;n</source>
        <translation>Körn&amp;ung</translation>
    </message>
    <message>
        <source>Exit s&amp;urfaces</source>
        <translation>Aus&amp;trittsflächen</translation>
    </message>
    <message>
        <source>Translucent tissue is shaded also where a line of sight leaves it, so that its far walls are seen; it lets less through, and needs lower opacities</source>
        <translation>Durchscheinendes Gewebe wird auch dort schattiert, wo eine Blicklinie es verlässt, sodass man seine hinteren Wände sieht; es lässt weniger durch und braucht geringere Deckkräfte</translation>
    </message>
    <message>
        <source>A fine grain where the drill has cut, for the eye alone: the image has none. It fades from afar</source>
        <translation>Eine feine Körnung, wo gebohrt wurde, nur fürs Auge: Das Bild hat keine. Von weitem verschwindet sie</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::PreviewBar</name>
    <message>
        <source>There is no picture of it: %1</source>
        <translation>Es gibt kein Bild davon: %1</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::PrintDialog</name>
    <message>
        <source>Picture for print</source>
        <translation>Bild für den Druck</translation>
    </message>
    <message>
        <source>&amp;Write the picture</source>
        <translation>Bild &amp;schreiben</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
    <message>
        <source>On paper</source>
        <translation>Auf Papier</translation>
    </message>
    <message>
        <source> dpi</source>
        <translation> dpi</translation>
    </message>
    <message>
        <source>Dots per inch: 300 for print, 600 for a journal&apos;s line art</source>
        <translation>Punkte je Zoll: 300 für den Druck, 600 für Strichzeichnungen einer Zeitschrift</translation>
    </message>
    <message>
        <source>W&amp;idth:</source>
        <translation>&amp;Breite:</translation>
    </message>
    <message>
        <source>&amp;Resolution:</source>
        <translation>&amp;Auflösung:</translation>
    </message>
    <message>
        <source>view</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>At most %1 pixels: choose a smaller width or resolution.</source>
        <translation>Höchstens %1 Pixel: Wählen Sie eine kleinere Breite oder Auflösung.</translation>
    </message>
    <message>
        <source>Let the name end in .png.</source>
        <translation>Der Name soll auf .png enden.</translation>
    </message>
    <message>
        <source> rays a pixel</source>
        <translation> Strahlen je Pixel</translation>
    </message>
    <message>
        <source>More smooth the edges and take as much longer</source>
        <translation>Mehr davon glätten die Ränder und dauern entsprechend länger</translation>
    </message>
    <message>
        <source>&amp;Smoothness:</source>
        <translation>&amp;Glättung:</translation>
    </message>
    <message>
        <source>1 ray a pixel</source>
        <translation>1 Strahl je Pixel</translation>
    </message>
    <message>
        <source>%1 x %2 pixels, of the 3D view with scale bar, side and the patient&apos;s directions. Measurements, bone thickness and tool are left out.</source>
        <translation>%1 x %2 Pixel, die 3D-Ansicht mit Maßstab, Seite und den Richtungen des Patienten. Messungen, Knochendicke und Werkzeug fehlen darin.</translation>
    </message>
    <message>
        <source>&amp;Background:</source>
        <translation>&amp;Hintergrund:</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ProbeLabel</name>
    <message>
        <source>Under the pointer: patient position from the scanner&apos;s zero (mm; R right, L left, A anterior, P posterior, I inferior, S superior), value of the image that is seen, structure</source>
        <translation>Unter dem Mauszeiger: Ort im Patienten vom Nullpunkt des Scanners aus (mm; R rechts, L links, A vorn, P hinten, I unten, S oben), Wert des sichtbaren Bildes, Struktur</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::PseudonymsDialog</name>
    <message>
        <source>Pseudonyms</source>
        <translation>Pseudonyme</translation>
    </message>
    <message>
        <source>Locked, as nothing was typed or clicked for a while.</source>
        <translation>Gesperrt, da eine Weile nichts getippt oder geklickt wurde.</translation>
    </message>
    <message>
        <source>File of the pseudonyms</source>
        <translation>Datei der Pseudonyme</translation>
    </message>
    <message>
        <source>&amp;Open</source>
        <translation>Ö&amp;ffnen</translation>
    </message>
    <message>
        <source>The file was made by De-identify DICOM files, with Remember who is behind the pseudonyms. What is in it names patients: it is shown here only, until this window is closed or locked.</source>
        <translation>Die Datei wurde von DICOM-Dateien de-identifizieren erzeugt, mit Merken, wer hinter den Pseudonymen steht. Ihr Inhalt nennt Patienten: Er wird nur hier gezeigt, bis dieses Fenster geschlossen oder gesperrt wird.</translation>
    </message>
    <message>
        <source>&amp;File:</source>
        <translation>Da&amp;tei:</translation>
    </message>
    <message>
        <source>&amp;Passphrase:</source>
        <translation>&amp;Passphrase:</translation>
    </message>
    <message>
        <source>Find a pseudonym, a patient or a UID</source>
        <translation>Pseudonym, Patienten oder UID suchen</translation>
    </message>
    <message>
        <source>Find</source>
        <translation>Suchen</translation>
    </message>
    <message>
        <source>&amp;Take in…</source>
        <translation>&amp;Aufnehmen…</translation>
    </message>
    <message>
        <source>The pseudonyms of another such file come to this one</source>
        <translation>Die Pseudonyme einer anderen solchen Datei kommen in diese</translation>
    </message>
    <message>
        <source>&amp;Copy…</source>
        <translation>&amp;Kopieren…</translation>
    </message>
    <message>
        <source>The whole map to another file, encrypted under a passphrase of its own</source>
        <translation>Die ganze Zuordnung in eine andere Datei, verschlüsselt mit einer eigenen Passphrase</translation>
    </message>
    <message>
        <source>C&amp;hange the passphrase…</source>
        <translation>Passphrase ä&amp;ndern…</translation>
    </message>
    <message>
        <source>&amp;Lock</source>
        <translation>&amp;Sperren</translation>
    </message>
    <message>
        <source>Closes the map; this window stays</source>
        <translation>Schließt die Zuordnung; dieses Fenster bleibt</translation>
    </message>
    <message>
        <source>Opening…</source>
        <translation>Wird geöffnet…</translation>
    </message>
    <message>
        <source>Once &amp;more:</source>
        <translation>N&amp;och einmal:</translation>
    </message>
    <message>
        <source>Choose the file.</source>
        <translation>Wählen Sie die Datei.</translation>
    </message>
    <message>
        <source>That file is there already; give the copy a new name.</source>
        <translation>Diese Datei gibt es schon; geben Sie der Kopie einen neuen Namen.</translation>
    </message>
    <message>
        <source>There is no such file.</source>
        <translation>Diese Datei gibt es nicht.</translation>
    </message>
    <message>
        <source>Type the same passphrase once more. Who forgets it cannot find out who is who.</source>
        <translation>Tippen Sie dieselbe Passphrase noch einmal. Wer sie vergisst, kann nicht herausfinden, wer wer ist.</translation>
    </message>
    <message>
        <source>Take in another map</source>
        <translation>Andere Zuordnung aufnehmen</translation>
    </message>
    <message>
        <source>The pseudonyms of another file of this kind come to this one; that stays as it is.</source>
        <translation>Die Pseudonyme einer anderen Datei dieser Art kommen in diese; jene bleibt, wie sie ist.</translation>
    </message>
    <message>
        <source>1 pseudonym is new.</source>
        <translation>1 Pseudonym ist neu.</translation>
    </message>
    <message>
        <source>%1 pseudonyms are new.</source>
        <translation>%1 Pseudonyme sind neu.</translation>
    </message>
    <message>
        <source>The other map has a key of its own: new files of these patients get other pseudonyms than those.</source>
        <translation>Die andere Zuordnung hat einen eigenen Schlüssel: Neue Dateien dieser Patienten erhalten andere Pseudonyme als jene.</translation>
    </message>
    <message>
        <source>Copy of the map</source>
        <translation>Kopie der Zuordnung</translation>
    </message>
    <message>
        <source>The whole map, with the key by which pseudonyms are made, under a passphrase of its own: a copy to keep, or for another computer of this house.</source>
        <translation>Die ganze Zuordnung, mit dem Schlüssel, nach dem Pseudonyme gebildet werden, unter einer eigenen Passphrase: eine Kopie zum Aufheben oder für einen anderen Rechner dieses Hauses.</translation>
    </message>
    <message>
        <source>Writing…</source>
        <translation>Wird geschrieben…</translation>
    </message>
    <message>
        <source>Copied to %1</source>
        <translation>Nach %1 kopiert</translation>
    </message>
    <message>
        <source>Change the passphrase</source>
        <translation>Passphrase ändern</translation>
    </message>
    <message>
        <source>From now on the file is opened by this passphrase. Copies keep theirs.</source>
        <translation>Von nun an wird die Datei mit dieser Passphrase geöffnet. Kopien behalten die ihre.</translation>
    </message>
    <message>
        <source>The passphrase is changed.</source>
        <translation>Die Passphrase ist geändert.</translation>
    </message>
    <message>
        <source>1 entry</source>
        <translation>1 Eintrag</translation>
    </message>
    <message>
        <source>%1 entries</source>
        <translation>%1 Einträge</translation>
    </message>
    <message>
        <source>The passphrase must have at least %1 characters.</source>
        <translation>Die Passphrase muss mindestens %1 Zeichen haben.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::PseudonymsModel</name>
    <message>
        <source>patient</source>
        <translation>Patient</translation>
    </message>
    <message>
        <source>study</source>
        <translation>Studie</translation>
    </message>
    <message>
        <source>series</source>
        <translation>Serie</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>Pseudonym</source>
        <translation>Pseudonym</translation>
    </message>
    <message>
        <source>Who or which it is</source>
        <translation>Wer oder was es ist</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ReceiveDialog</name>
    <message>
        <source>&amp;Between</source>
        <translation>&amp;Zwischen</translation>
    </message>
    <message>
        <source>Receive from a node</source>
        <translation>Von einem Knoten empfangen</translation>
    </message>
    <message>
        <source>* stands for any text</source>
        <translation>* steht für beliebigen Text</translation>
    </message>
    <message>
        <source>family name, or family^given</source>
        <translation>Nachname oder Nachname^Vorname</translation>
    </message>
    <message>
        <source>The beginning is enough; * stands for any text</source>
        <translation>Der Anfang genügt; * steht für beliebigen Text</translation>
    </message>
    <message>
        <source>any</source>
        <translation>beliebig</translation>
    </message>
    <message>
        <source>OT (Petrous scenes)</source>
        <translation>OT (Petrous-Szenen)</translation>
    </message>
    <message>
        <source>Patients and series that were found</source>
        <translation>Gefundene Patienten und Serien</translation>
    </message>
    <message>
        <source>ID</source>
        <translation>ID</translation>
    </message>
    <message>
        <source>Date</source>
        <translation>Datum</translation>
    </message>
    <message>
        <source>Description</source>
        <translation>Beschreibung</translation>
    </message>
    <message>
        <source>Modality</source>
        <translation>Modalität</translation>
    </message>
    <message>
        <source>Images</source>
        <translation>Bilder</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>&amp;Node:</source>
        <translation>&amp;Knoten:</translation>
    </message>
    <message>
        <source>Patient &amp;ID:</source>
        <translation>Patienten-&amp;ID:</translation>
    </message>
    <message>
        <source>Study date:</source>
        <translation>Studiendatum:</translation>
    </message>
    <message>
        <source>&amp;Modality:</source>
        <translation>&amp;Modalität:</translation>
    </message>
    <message>
        <source>&amp;Search</source>
        <translation>&amp;Suchen</translation>
    </message>
    <message>
        <source>&amp;Receive</source>
        <translation>&amp;Empfangen</translation>
    </message>
    <message>
        <source>Stopped</source>
        <translation>Angehalten</translation>
    </message>
    <message>
        <source>&amp;Stop</source>
        <translation>&amp;Anhalten</translation>
    </message>
    <message>
        <source>The first date is after the last one.</source>
        <translation>Das erste Datum liegt nach dem letzten.</translation>
    </message>
    <message>
        <source>Asking “%1”…</source>
        <translation>„%1“ wird gefragt…</translation>
    </message>
    <message>
        <source>“%1” has no such study.</source>
        <translation>„%1“ hat keine solche Studie.</translation>
    </message>
    <message>
        <source>%1 studies; the latest %2 are shown. Give more of the patient, or fewer days.</source>
        <translation>%1 Studien; die jüngsten %2 werden gezeigt. Geben Sie mehr über den Patienten an oder weniger Tage.</translation>
    </message>
    <message>
        <source>1 study</source>
        <translation>1 Studie</translation>
    </message>
    <message>
        <source>%1 studies</source>
        <translation>%1 Studien</translation>
    </message>
    <message>
        <source>Asking “%1” for the series…</source>
        <translation>„%1“ wird nach den Serien gefragt…</translation>
    </message>
    <message>
        <source>Petrous case</source>
        <translation>Petrous-Fall</translation>
    </message>
    <message>
        <source>Series %1</source>
        <translation>Serie %1</translation>
    </message>
    <message>
        <source>The study holds a case of Petrous: it comes as it was sent.</source>
        <translation>Die Studie enthält einen Fall von Petrous: Er kommt, wie er gesendet wurde.</translation>
    </message>
    <message>
        <source>Tick the series to receive; they are then imported as a folder of DICOM is.</source>
        <translation>Kreuzen Sie die zu empfangenden Serien an; sie werden dann wie ein DICOM-Ordner importiert.</translation>
    </message>
    <message>
        <source>Series of one study, or a case of Petrous</source>
        <translation>Serien einer Studie oder ein Fall von Petrous</translation>
    </message>
    <message>
        <source>of a case that was sent by Petrous</source>
        <translation>eines Falls, den Petrous gesendet hat</translation>
    </message>
    <message>
        <source>A part of the name is enough; * stands for any text</source>
        <translation>Ein Teil des Namens genügt; * steht für beliebigen Text</translation>
    </message>
    <message>
        <source>Case, patient, or series</source>
        <translation>Fall, Patient oder Serie</translation>
    </message>
    <message>
        <source>C&amp;ase:</source>
        <translation>F&amp;all:</translation>
    </message>
    <message>
        <source>Search as it is for all cases of Petrous, or give the name of a case, or the patient&apos;s ID, name or a date. Open a study to see its series.</source>
        <translation>Suchen Sie ohne Angaben nach allen Fällen von Petrous, oder geben Sie den Namen eines Falls oder ID, Namen oder ein Datum des Patienten an. Öffnen Sie eine Studie, um ihre Serien zu sehen.</translation>
    </message>
    <message>
        <source>Case “%1”</source>
        <translation>Fall „%1“</translation>
    </message>
    <message>
        <source>Case, name not told</source>
        <translation>Fall, Name nicht genannt</translation>
    </message>
    <message>
        <source>Case “%1”, there of the patient %2</source>
        <translation>Fall „%1“, dort vom Patienten %2</translation>
    </message>
    <message>
        <source>Study %1</source>
        <translation>Studie %1</translation>
    </message>
    <message>
        <source>Pa&amp;tient name:</source>
        <translation>Patienten&amp;name:</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::RegionDialog</name>
    <message>
        <source>%1 million voxels, %2 MB</source>
        <translation>%1 Millionen Voxel, %2 MB</translation>
    </message>
    <message>
        <source>&amp;Whole scan</source>
        <translation>&amp;Ganze Aufnahme</translation>
    </message>
    <message>
        <source>Region of the scan</source>
        <translation>Ausschnitt der Aufnahme</translation>
    </message>
    <message>
        <source>Only what lies in the box is read: drag its edges, or give it in mm (patient LPS).</source>
        <translation>Nur was im Quader liegt, wird gelesen: Ziehen Sie seine Kanten oder geben Sie ihn in mm an (LPS des Patienten).</translation>
    </message>
    <message>
        <source>%1: %2, of %3</source>
        <translation>%1: %2, von %3</translation>
    </message>
    <message>
        <source>Drag an edge of the box, or the box.  Outside it: move the crosshair.  Wheel: scroll.</source>
        <translation>Ziehen Sie eine Kante des Quaders oder den Quader.  Außerhalb: Fadenkreuz bewegen.  Rad: blättern.</translation>
    </message>
    <message>
        <source>Only what lies in the box is read: drag its edges, or give it in mm (the file&apos;s LPS). The letters at the slices are the patient&apos;s, by the corrected axes.</source>
        <translation>Gelesen wird nur, was im Quader liegt: Ziehen Sie seine Kanten, oder geben Sie ihn in mm an (LPS der Datei). Die Buchstaben an den Schichten sind die des Patienten, nach den korrigierten Achsen.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::RegistrationController</name>
    <message>
        <source>&amp;Registration</source>
        <translation>&amp;Registrierung</translation>
    </message>
    <message>
        <source>&amp;Register the MR</source>
        <translation>MR &amp;registrieren</translation>
    </message>
    <message>
        <source>Re&amp;fine</source>
        <translation>&amp;Verfeinern</translation>
    </message>
    <message>
        <source>The same from where the MR lies now</source>
        <translation>Dasselbe von dort aus, wo das MR jetzt liegt</translation>
    </message>
    <message>
        <source>&amp;Cancel</source>
        <translation>&amp;Abbrechen</translation>
    </message>
    <message>
        <source>Stops the registration; what it reached can be kept</source>
        <translation>Hält die Registrierung an; was sie erreicht hat, lässt sich behalten</translation>
    </message>
    <message>
        <source>To see whether they agree</source>
        <translation>Um zu sehen, ob sie übereinstimmen</translation>
    </message>
    <message>
        <source>Ne&amp;xt way to show the MR</source>
        <translation>&amp;Nächste Darstellung des MR</translation>
    </message>
    <message>
        <source>&amp;Point here</source>
        <translation>&amp;Punkt hier</translation>
    </message>
    <message>
        <source>&amp;Undo the MR&apos;s move</source>
        <translation>Bewegung des MR rück&amp;gängig</translation>
    </message>
    <message>
        <source>Back to how the MR lay before</source>
        <translation>Zurück zur vorigen Lage des MR</translation>
    </message>
    <message>
        <source>Red&amp;o the MR&apos;s move</source>
        <translation>Bewegung des MR &amp;wiederholen</translation>
    </message>
    <message>
        <source>Forth again</source>
        <translation>Wieder vor</translation>
    </message>
    <message>
        <source>Lays the MR on the %1 by mutual information, as the panel says</source>
        <translation>Legt das MR durch Transinformation auf das %1, wie es der Bereich angibt</translation>
    </message>
    <message>
        <source>%1 or MR alone, by &amp;turns</source>
        <translation>%1 oder MR allein, im Wech&amp;sel</translation>
    </message>
    <message>
        <source>%1 alone, blend, the edges of the %1 over the MR, checkerboard</source>
        <translation>%1 allein, überblendet, die Kanten des %1 über dem MR, Schachbrett</translation>
    </message>
    <message>
        <source>The crosshair marks a point of the %1, then the same point of the MR</source>
        <translation>Das Fadenkreuz markiert einen Punkt des %1, dann denselben Punkt des MR</translation>
    </message>
    <message>
        <source>The case has no MR (Case &gt; Add MR…)</source>
        <translation>Der Fall hat kein MR (Fall &gt; MR hinzufügen…)</translation>
    </message>
    <message>
        <source>The slices go on showing %1, which is being registered; choose the MR under Registration (F5)</source>
        <translation>Die Schichten zeigen weiter %1, das gerade registriert wird; wählen Sie das MR unter Registrierung (F5)</translation>
    </message>
    <message>
        <source>Stopped: the MR to which it was being registered is gone; it lies as before.</source>
        <translation>Angehalten: Das MR, auf das registriert wurde, ist weg; es liegt wie zuvor.</translation>
    </message>
    <message>
        <source>Failed, and nothing was changed: %1</source>
        <translation>Fehlgeschlagen, und nichts wurde geändert: %1</translation>
    </message>
    <message>
        <source>The registration failed</source>
        <translation>Die Registrierung ist fehlgeschlagen</translation>
    </message>
    <message>
        <source>MR %1: %2</source>
        <translation>MR %1: %2</translation>
    </message>
    <message>
        <source>Done; the MR is laid as soon as the drill stands still.</source>
        <translation>Fertig; das MR wird gelegt, sobald der Bohrer stillsteht.</translation>
    </message>
    <message>
        <source>Stopped; the MR lies as before.</source>
        <translation>Angehalten; das MR liegt wie zuvor.</translation>
    </message>
    <message>
        <source>Petrous</source>
        <translation>Petrous</translation>
    </message>
    <message>
        <source>The registration was stopped. Keep the best place that it had found by then? Nobody has judged it; it can be undone.</source>
        <translation>Die Registrierung wurde angehalten. Die beste bis dahin gefundene Lage behalten? Niemand hat sie beurteilt; sie lässt sich rückgängig machen.</translation>
    </message>
    <message>
        <source>Keep it</source>
        <translation>Behalten</translation>
    </message>
    <message>
        <source>As before</source>
        <translation>Wie zuvor</translation>
    </message>
    <message>
        <source>Kept as it was when it was stopped.</source>
        <translation>Behalten, wie es beim Anhalten war.</translation>
    </message>
    <message>
        <source>The drill runs; the MR lies as before.</source>
        <translation>Der Bohrer läuft; das MR liegt wie zuvor.</translation>
    </message>
    <message>
        <source>Now the same point in the MR: crosshair there, then K.</source>
        <translation>Nun derselbe Punkt im MR: Fadenkreuz dorthin, dann K.</translation>
    </message>
    <message>
        <source>The next point in the %1; three pairs at least, far apart.</source>
        <translation>Der nächste Punkt im %1; mindestens drei Paare, weit auseinander.</translation>
    </message>
    <message>
        <source>Metric: being prepared…</source>
        <translation>Metrik: wird vorbereitet…</translation>
    </message>
    <message>
        <source>Metric with the %1 %2</source>
        <translation>Metrik mit dem %1 %2</translation>
    </message>
    <message>
        <source> (%1%2 by hand)</source>
        <translation> (%1%2 von Hand)</translation>
    </message>
    <message>
        <source>The registration ended with its case; the MR lies as before</source>
        <translation>Die Registrierung endete mit ihrem Fall; das MR liegt wie zuvor</translation>
    </message>
    <message>
        <source>the registration of the MR “%1”</source>
        <translation>Registrierung des MR „%1“</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::RegistrationPanel</name>
    <message>
        <source>Median error %1 mm, largest %2 mm</source>
        <translation>Mittlerer Fehler (Median) %1 mm, größter %2 mm</translation>
    </message>
    <message>
        <source>MR</source>
        <translation>MR</translation>
    </message>
    <message>
        <source>By pairs of points</source>
        <translation>Nach Punktepaaren</translation>
    </message>
    <message>
        <source>By hand</source>
        <translation>Von Hand</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>Back to how the MR lay before (Ctrl+Alt+Z)</source>
        <translation>Zurück zur vorigen Lage des MR (Strg+Alt+Z)</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Wiederholen</translation>
    </message>
    <message>
        <source>Forth again (Ctrl+Alt+Y)</source>
        <translation>Wieder vor (Strg+Alt+Y)</translation>
    </message>
    <message>
        <source>Unregister</source>
        <translation>Registrierung lösen</translation>
    </message>
    <message>
        <source>Blend</source>
        <translation>Überblendet</translation>
    </message>
    <message>
        <source>Checkerboard</source>
        <translation>Schachbrett</translation>
    </message>
    <message>
        <source>Opacity of the MR in the blend</source>
        <translation>Deckkraft des MR in der Überblendung</translation>
    </message>
    <message>
        <source>&amp;Slices show</source>
        <translation>&amp;Schichten zeigen</translation>
    </message>
    <message>
        <source>MR &amp;opacity</source>
        <translation>MR-&amp;Deckkraft</translation>
    </message>
    <message>
        <source>By mutual information</source>
        <translation>Nach Transinformation</translation>
    </message>
    <message>
        <source>&amp;Register</source>
        <translation>&amp;Registrieren</translation>
    </message>
    <message>
        <source>Re&amp;fine</source>
        <translation>&amp;Verfeinern</translation>
    </message>
    <message>
        <source>The same from where the MR lies now, without a search: after points or the hand</source>
        <translation>Dasselbe von dort aus, wo das MR jetzt liegt, ohne Suche: nach Punkten oder der Hand</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Stops; what was reached by then can be kept</source>
        <translation>Hält an; was bis dahin erreicht ist, lässt sich behalten</translation>
    </message>
    <message>
        <source>Sign-off</source>
        <translation>Freigabe</translation>
    </message>
    <message>
        <source>The surgeon&apos;s name</source>
        <translation>Name des Chirurgen</translation>
    </message>
    <message>
        <source>Sign</source>
        <translation>Freigeben</translation>
    </message>
    <message>
        <source>I have looked at it and accept how the MR lies; void once it moves</source>
        <translation>Ich habe es angesehen und akzeptiere, wie das MR liegt; hinfällig, sobald es sich bewegt</translation>
    </message>
    <message>
        <source>The MR has no place on the %1 any more</source>
        <translation>Das MR hat keinen Ort mehr auf dem %1</translation>
    </message>
    <message>
        <source>How the slices show the MR (O: the next way, V: %1 or MR alone by turns)</source>
        <translation>Wie die Schichten das MR zeigen (O: die nächste Art, V: %1 oder MR allein im Wechsel)</translation>
    </message>
    <message>
        <source>Looks for where the MR fits the %1, lays it there, and says how well it lies (Ctrl+R)</source>
        <translation>Sucht, wo das MR auf das %1 passt, legt es dorthin und sagt, wie gut es liegt (Strg+R)</translation>
    </message>
    <message>
        <source>Mutual information of %1 and MR as they lie now; higher is better</source>
        <translation>Transinformation von %1 und MR, wie sie jetzt liegen; höher ist besser</translation>
    </message>
    <message>
        <source>%1 alone</source>
        <translation>%1 allein</translation>
    </message>
    <message>
        <source>%1&apos;s edges over the MR</source>
        <translation>Kanten des %1 über dem MR</translation>
    </message>
    <message>
        <source>The MR that is registered and shown over the slices</source>
        <translation>Das MR, das registriert und über den Schichten gezeigt wird</translation>
    </message>
    <message>
        <source>The case has no other MR; add one with Case &gt; Add MR…</source>
        <translation>Der Fall hat kein anderes MR; fügen Sie eines hinzu: Fall &gt; MR hinzufügen…</translation>
    </message>
    <message>
        <source>The case has no MR; add one with Case &gt; Add MR…</source>
        <translation>Der Fall hat kein MR; fügen Sie eines hinzu: Fall &gt; MR hinzufügen…</translation>
    </message>
    <message>
        <source>Undo %1 (Ctrl+Alt+Z)</source>
        <translation>%1 rückgängig (Strg+Alt+Z)</translation>
    </message>
    <message>
        <source>Redo %1 (Ctrl+Alt+Y)</source>
        <translation>%1 wiederholen (Strg+Alt+Y)</translation>
    </message>
    <message>
        <source>Open a case first</source>
        <translation>Öffnen Sie zuerst einen Fall</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::RegistrationTargetBox</name>
    <message>
        <source>Fits t&amp;o</source>
        <translation>Passt a&amp;uf</translation>
    </message>
    <message>
        <source>Register looks around this place, 40 mm and 40° far; images of one frame of reference begin where that puts them</source>
        <translation>Registrieren sucht um diesen Ort, 40 mm und 40° weit; Bilder eines Bezugssystems beginnen, wo dieses sie hinlegt</translation>
    </message>
    <message>
        <source>as the files say</source>
        <translation>wie die Dateien sagen</translation>
    </message>
    <message>
        <source>middle on middle</source>
        <translation>Mitte auf Mitte</translation>
    </message>
    <message>
        <source>where the MR lies now</source>
        <translation>wo das MR jetzt liegt</translation>
    </message>
    <message>
        <source>S&amp;tart</source>
        <translation>S&amp;tart</translation>
    </message>
    <message>
        <source> mm about the crosshair</source>
        <translation> mm um das Fadenkreuz</translation>
    </message>
    <message>
        <source>Re&amp;gion</source>
        <translation>Ausschn&amp;itt</translation>
    </message>
    <message>
        <source>Where the error is stated. The middle ear: an ossicle, or else the tympanic cavity or the inner ear; without these the centre of what both images show</source>
        <translation>Wo der Fehler angegeben wird. Das Mittelohr: ein Gehörknöchelchen, sonst die Paukenhöhle oder das Innenohr; ohne diese die Mitte dessen, was beide Bilder zeigen</translation>
    </message>
    <message>
        <source>Error &amp;at</source>
        <translation>F&amp;ehler bei</translation>
    </message>
    <message>
        <source>the middle ear</source>
        <translation>dem Mittelohr</translation>
    </message>
    <message>
        <source>the crosshair</source>
        <translation>dem Fadenkreuz</translation>
    </message>
    <message>
        <source>A diffusion image finds more to hold on to in the T2 of the same session, and comes to the %1 through that, once it is registered itself</source>
        <translation>Ein Diffusionsbild findet mehr Halt im T2 derselben Sitzung und kommt darüber zum %1, sobald dieses selbst registriert ist</translation>
    </message>
    <message>
        <source>What of the %1 counts: all of it, or a box of this edge about the crosshair, as for one ear where the jaw or neck has moved</source>
        <translation>Was vom %1 zählt: alles oder ein Würfel dieser Kante um das Fadenkreuz, etwa für ein Ohr, wo Kiefer oder Hals sich bewegt haben</translation>
    </message>
    <message>
        <source>the whole %1</source>
        <translation>das ganze %1</translation>
    </message>
    <message>
        <source>the %1</source>
        <translation>das %1</translation>
    </message>
    <message>
        <source>mesh</source>
        <translation>Netz</translation>
    </message>
    <message>
        <source>drawn on %1</source>
        <translation>gezeichnet auf %1</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>Chosen: %1</source>
        <translation>Gewählt: %1</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::RepairDialog</name>
    <message>
        <source> At stake: %1 mm.</source>
        <translation> Es geht um %1 mm.</translation>
    </message>
    <message>
        <source>The pictures of it before and after are being made. In any case each slice is put where its position says, by linear interpolation.</source>
        <translation>Die Bilder davor und danach werden erstellt. In jedem Fall kommt jede Schicht dorthin, wo ihre Position es sagt, durch lineare Interpolation.</translation>
    </message>
    <message>
        <source>Repair the scan?</source>
        <translation>Aufnahme reparieren?</translation>
    </message>
    <message>
        <source>“%1” would mislead as it is. What is wrong:</source>
        <translation>„%1“ wäre, wie es ist, irreführend. Was falsch ist:</translation>
    </message>
    <message>
        <source>&amp;Repair and open</source>
        <translation>&amp;Reparieren und öffnen</translation>
    </message>
    <message>
        <source>Open &amp;another…</source>
        <translation>&amp;Anderes öffnen…</translation>
    </message>
    <message>
        <source>Before: the slices as they lie in the files</source>
        <translation>Davor: die Schichten, wie sie in den Dateien liegen</translation>
    </message>
    <message>
        <source>After: repaired</source>
        <translation>Danach: repariert</translation>
    </message>
    <message>
        <source>What remains:</source>
        <translation>Was bleibt:</translation>
    </message>
    <message>
        <source>• Linear interpolation smooths detail below about %1 mm.</source>
        <translation>• Lineare Interpolation glättet Einzelheiten unter etwa %1 mm.</translation>
    </message>
    <message>
        <source>• Interpolated slices are orange here, and marked wherever the case is shown.</source>
        <translation>• Interpolierte Schichten sind hier orange und überall markiert, wo der Fall gezeigt wird.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ReplayController</name>
    <message>
        <source>%1, attached</source>
        <translation>%1, angehängt</translation>
    </message>
    <message>
        <source>Open a recording</source>
        <translation>Aufzeichnung öffnen</translation>
    </message>
    <message>
        <source>Recordings (*.ticks)</source>
        <translation>Aufzeichnungen (*.ticks)</translation>
    </message>
    <message>
        <source>All files (*)</source>
        <translation>Alle Dateien (*)</translation>
    </message>
    <message>
        <source>The recording is read when the drill is let go.</source>
        <translation>Die Aufzeichnung wird gelesen, wenn der Bohrer losgelassen ist.</translation>
    </message>
    <message>
        <source>The case is still being prepared; then the recording is read.</source>
        <translation>Der Fall wird noch vorbereitet; danach wird die Aufzeichnung gelesen.</translation>
    </message>
    <message>
        <source>Reading the recording, and measuring what was drilled in it…</source>
        <translation>Die Aufzeichnung wird gelesen, und was darin gebohrt wurde, gemessen…</translation>
    </message>
    <message>
        <source>The recording is empty: the tool was never placed.</source>
        <translation>Die Aufzeichnung ist leer: Das Werkzeug war nie gesetzt.</translation>
    </message>
    <message>
        <source>Choose a recording first, or open one (Drill &gt; Open a recording…)</source>
        <translation>Wählen Sie zuerst eine Aufzeichnung, oder öffnen Sie eine (Bohren &gt; Aufzeichnung öffnen…)</translation>
    </message>
    <message>
        <source>Metrics (*.csv)</source>
        <translation>Kennzahlen (*.csv)</translation>
    </message>
    <message>
        <source>Export the recording</source>
        <translation>Aufzeichnung exportieren</translation>
    </message>
    <message>
        <source>Place and force over time (*.csv)</source>
        <translation>Ort und Kraft über der Zeit (*.csv)</translation>
    </message>
    <message>
        <source>The table is in %1</source>
        <translation>Die Tabelle ist in %1</translation>
    </message>
    <message>
        <source>Play recording</source>
        <translation>Aufzeichnung abspielen</translation>
    </message>
    <message>
        <source>Pause recording</source>
        <translation>Aufzeichnung anhalten</translation>
    </message>
    <message>
        <source>%1 and %2 more</source>
        <translation>%1 und %2 weitere</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ReplayPanel</name>
    <message>
        <source>Force on the hand over time, N; the ground is lighter while the burr turned, and the line is the time that is shown</source>
        <translation>Kraft auf die Hand über der Zeit, N; der Grund ist heller, solange die Fräse lief, und die Linie ist die gezeigte Zeit</translation>
    </message>
    <message>
        <source>Force over time</source>
        <translation>Kraft über der Zeit</translation>
    </message>
    <message>
        <source>N</source>
        <translation>N</translation>
    </message>
    <message>
        <source>Recordings of this case: those in the library&apos;s folder, and attached ones</source>
        <translation>Aufzeichnungen dieses Falls: die im Ordner der Bibliothek und angehängte</translation>
    </message>
    <message>
        <source>How fast it is played</source>
        <translation>Wie schnell sie abgespielt wird</translation>
    </message>
    <message>
        <source>&amp;Ghost of the tool</source>
        <translation>Werkzeug als &amp;Geist</translation>
    </message>
    <message>
        <source>&amp;Start with my drill</source>
        <translation>Mit meinem Bohrer &amp;beginnen</translation>
    </message>
    <message>
        <source>Metrics of the recording</source>
        <translation>Kennzahlen der Aufzeichnung</translation>
    </message>
    <message>
        <source>Metric</source>
        <translation>Kennzahl</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Structures in the recording</source>
        <translation>Strukturen in der Aufzeichnung</translation>
    </message>
    <message>
        <source>Structure</source>
        <translation>Struktur</translation>
    </message>
    <message>
        <source>Nearest</source>
        <translation>Kleinster Abstand</translation>
    </message>
    <message>
        <source>Drilled</source>
        <translation>Gebohrt</translation>
    </message>
    <message>
        <source>E&amp;xport…</source>
        <translation>E&amp;xportieren…</translation>
    </message>
    <message>
        <source>Metrics, or place and force over time, as CSV</source>
        <translation>Kennzahlen, oder Ort und Kraft über der Zeit, als CSV</translation>
    </message>
    <message>
        <source>&amp;Open…</source>
        <translation>Ö&amp;ffnen…</translation>
    </message>
    <message>
        <source>A recording from a file (*.ticks)</source>
        <translation>Eine Aufzeichnung aus einer Datei (*.ticks)</translation>
    </message>
    <message>
        <source>Time in the recording</source>
        <translation>Zeit in der Aufzeichnung</translation>
    </message>
    <message>
        <source>Time in the recording: arrow keys by a second, page keys by ten</source>
        <translation>Zeit in der Aufzeichnung: Pfeiltasten um eine Sekunde, Bildtasten um zehn</translation>
    </message>
    <message>
        <source>The recorded tool in the 3D view, as a wire frame beside the tool in use</source>
        <translation>Das aufgezeichnete Werkzeug in der 3D-Ansicht, als Drahtgitter neben dem eigenen</translation>
    </message>
    <message>
        <source>The recording begins as soon as your burr drills: your stroke beside the recorded one</source>
        <translation>Die Aufzeichnung beginnt, sobald Ihre Fräse bohrt: Ihr Bohrzug neben dem aufgezeichneten</translation>
    </message>
    <message>
        <source>How near the burr came to the structure, 0 where it reached it, and what was drilled of it</source>
        <translation>Wie nahe die Fräse der Struktur kam, „erreicht“, wo sie diese berührte, und was von ihr gebohrt wurde</translation>
    </message>
    <message>
        <source>Force %1 N, thrust %2 N, drilling</source>
        <translation>Kraft %1 N, Andruck %2 N, bohrt</translation>
    </message>
    <message>
        <source>Force %1 N, thrust %2 N</source>
        <translation>Kraft %1 N, Andruck %2 N</translation>
    </message>
    <message>
        <source>Tool</source>
        <translation>Werkzeug</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Time drilling</source>
        <translation>Bohrzeit</translation>
    </message>
    <message>
        <source>Path of the burr</source>
        <translation>Weg der Fräse</translation>
    </message>
    <message>
        <source>mm</source>
        <translation>mm</translation>
    </message>
    <message>
        <source>Path drilling</source>
        <translation>Weg beim Bohren</translation>
    </message>
    <message>
        <source>Mean force drilling</source>
        <translation>Mittlere Kraft beim Bohren</translation>
    </message>
    <message>
        <source>Largest force</source>
        <translation>Größte Kraft</translation>
    </message>
    <message>
        <source>Largest thrust</source>
        <translation>Größter Andruck</translation>
    </message>
    <message>
        <source>Strokes</source>
        <translation>Bohrzüge</translation>
    </message>
    <message>
        <source>Removed</source>
        <translation>Abgetragen</translation>
    </message>
    <message>
        <source>reached</source>
        <translation>erreicht</translation>
    </message>
    <message>
        <source>nothing</source>
        <translation>nichts</translation>
    </message>
    <message>
        <source>What was drilled is not known here: the recording %1</source>
        <translation>Was gebohrt wurde, ist hier nicht bekannt: Die Aufzeichnung %1</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Aufzeichnung</translation>
    </message>
    <message>
        <source>No recording yet</source>
        <translation>Noch keine Aufzeichnung</translation>
    </message>
    <message>
        <source>Choose a recording</source>
        <translation>Aufzeichnung wählen</translation>
    </message>
    <message>
        <source>Mean speed drilling</source>
        <translation>Mittlere Drehzahl beim Bohren</translation>
    </message>
    <message>
        <source>/min</source>
        <translation>/min</translation>
    </message>
    <message>
        <source>Highest speed</source>
        <translation>Höchste Drehzahl</translation>
    </message>
    <message>
        <source>Times the drill was switched on</source>
        <translation>Wie oft der Bohrer eingeschaltet wurde</translation>
    </message>
    <message>
        <source>Recordings of the operation</source>
        <translation>Aufzeichnungen der Operation</translation>
    </message>
    <message>
        <source>Drilling</source>
        <translation>Bohrzeit</translation>
    </message>
    <message>
        <source>Path</source>
        <translation>Weg</translation>
    </message>
    <message>
        <source>An operation has a recording for each burr. The tables below are those of the line that is chosen, which the time goes to</source>
        <translation>Eine Operation hat für jeden Bohrer eine Aufzeichnung. Die Tabellen darunter gehören zur gewählten Zeile, zu deren Beginn die Zeit geht</translation>
    </message>
    <message>
        <source>Together</source>
        <translation>Zusammen</translation>
    </message>
    <message>
        <source>All recordings of the operation, without the pauses between them</source>
        <translation>Alle Aufzeichnungen der Operation, ohne die Pausen dazwischen</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ReportDialog</name>
    <message>
        <source>Report of the plan</source>
        <translation>Bericht zum Plan</translation>
    </message>
    <message>
        <source>&amp;Write the report</source>
        <translation>Bericht sch&amp;reiben</translation>
    </message>
    <message>
        <source>with the &amp;date of the planned operation</source>
        <translation>mit dem &amp;Datum der geplanten Operation</translation>
    </message>
    <message>
        <source>with &amp;names and the note as typed, and who signed</source>
        <translation>mit &amp;Namen und Notiz wie getippt und wer freigab</translation>
    </message>
    <message>
        <source>Who has the list of that day&apos;s operations knows the patient by it</source>
        <translation>Wer den Operationsplan dieses Tages hat, erkennt daran den Patienten</translation>
    </message>
    <message>
        <source>For a report that stays here. Otherwise a name that may tell who the patient is becomes a number</source>
        <translation>Für einen Bericht, der hier bleibt. Sonst wird ein Name, der verraten kann, wer der Patient ist, zu einer Nummer</translation>
    </message>
    <message>
        <source>&amp;Approach:</source>
        <translation>&amp;Zugang:</translation>
    </message>
    <message>
        <source>&amp;Language:</source>
        <translation>&amp;Sprache:</translation>
    </message>
    <message>
        <source>What:</source>
        <translation>Was:</translation>
    </message>
    <message>
        <source>Pictures, slices at the key places, distances of the dissection, strokes, measurements, structures, registration, and what was assumed at import. A name that ends in .html writes one page for a browser.</source>
        <translation>Bilder, Schichten an den wichtigen Stellen, Abstände der Bohrung, Bohrzüge, Messungen, Strukturen, Registrierung und was beim Import angenommen wurde. Ein Name, der auf .html endet, schreibt eine Seite für einen Browser.</translation>
    </message>
    <message>
        <source>plan</source>
        <translation>Plan</translation>
    </message>
    <message>
        <source>Let the name end in .pdf or .html.</source>
        <translation>Der Name soll auf .pdf oder .html enden.</translation>
    </message>
    <message>
        <source>“%1” is left out, as it is nowhere on the %2: %3</source>
        <translation>„%1“ ist weggelassen, da es nirgends auf dem %2 liegt: %3</translation>
    </message>
    <message>
        <source>“%1” stays where it was made: %2</source>
        <translation>„%1“ bleibt, wo es gemacht wurde: %2</translation>
    </message>
    <message>
        <source>The report says so, too</source>
        <translation>Das steht auch im Bericht</translation>
    </message>
    <message>
        <source>Without:</source>
        <translation>Ohne:</translation>
    </message>
    <message>
        <source>&amp;Background:</source>
        <translation>&amp;Hintergrund:</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::SceneDisplay</name>
    <message>
        <source>the graphics driver was reset and lost the picture</source>
        <translation>der Grafiktreiber wurde zurückgesetzt und verlor das Bild</translation>
    </message>
    <message>
        <source>the picture could not be drawn</source>
        <translation>das Bild konnte nicht gezeichnet werden</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::SegmentController</name>
    <message>
        <source>&amp;Threshold</source>
        <translation>&amp;Schwellwert</translation>
    </message>
    <message>
        <source>All voxels in a range of intensities, or those connected to a clicked point</source>
        <translation>Alle Voxel in einem Bereich von Intensitäten oder die mit einem angeklickten Punkt verbundenen</translation>
    </message>
    <message>
        <source>&amp;Paint</source>
        <translation>&amp;Malen</translation>
    </message>
    <message>
        <source>Paints with a ball or a disk in the slices</source>
        <translation>Malt mit einer Kugel oder Scheibe in den Schichten</translation>
    </message>
    <message>
        <source>&amp;Erase</source>
        <translation>&amp;Radieren</translation>
    </message>
    <message>
        <source>Erases with a ball or a disk in the slices</source>
        <translation>Radiert mit einer Kugel oder Scheibe in den Schichten</translation>
    </message>
    <message>
        <source>&amp;Grow</source>
        <translation>&amp;Wachsen</translation>
    </message>
    <message>
        <source>From strokes inside the structure and beside it, by the image</source>
        <translation>Aus Strichen in der Struktur und daneben, nach dem Bild</translation>
    </message>
    <message>
        <source>&amp;Fill</source>
        <translation>&amp;Füllen</translation>
    </message>
    <message>
        <source>The slices between those that were painted</source>
        <translation>Die Schichten zwischen den gemalten</translation>
    </message>
    <message>
        <source>&amp;Nerve</source>
        <translation>&amp;Nerv</translation>
    </message>
    <message>
        <source>A tube along a few clicked points: facial nerve, chorda, vessels</source>
        <translation>Eine Röhre entlang weniger angeklickter Punkte: N. facialis, Chorda tympani, Gefäße</translation>
    </message>
    <message>
        <source>&amp;Islands</source>
        <translation>&amp;Inseln</translation>
    </message>
    <message>
        <source>Removes small parts</source>
        <translation>Entfernt kleine Teile</translation>
    </message>
    <message>
        <source>&amp;Margin</source>
        <translation>Ran&amp;d</translation>
    </message>
    <message>
        <source>Wider or narrower by some millimetres</source>
        <translation>Um einige Millimeter weiter oder enger</translation>
    </message>
    <message>
        <source>&amp;Smooth</source>
        <translation>&amp;Glätten</translation>
    </message>
    <message>
        <source>Rounds the surface</source>
        <translation>Rundet die Oberfläche</translation>
    </message>
    <message>
        <source>%1 is a structure of the case now, %2; Undo makes it a draft again</source>
        <translation>%1 ist jetzt eine Struktur des Falls, %2; Rückgängig macht sie wieder zum Entwurf</translation>
    </message>
    <message>
        <source>&amp;Apply the tool</source>
        <translation>Werkzeug &amp;anwenden</translation>
    </message>
    <message>
        <source>One step on the draft, which can be undone</source>
        <translation>Ein Schritt am Entwurf, der sich rückgängig machen lässt</translation>
    </message>
    <message>
        <source>&amp;Create the structure</source>
        <translation>Struktur &amp;erstellen</translation>
    </message>
    <message>
        <source>The draft becomes a structure of the case</source>
        <translation>Der Entwurf wird eine Struktur des Falls</translation>
    </message>
    <message>
        <source>&amp;Leave the tool, or discard the draft</source>
        <translation>Werkzeug ab&amp;legen oder Entwurf verwerfen</translation>
    </message>
    <message>
        <source>Puts the tool away; without a tool asks whether the draft is dropped</source>
        <translation>Legt das Werkzeug weg; ohne Werkzeug die Frage, ob der Entwurf verworfen wird</translation>
    </message>
    <message>
        <source>Stopped; the draft is as before.</source>
        <translation>Angehalten; der Entwurf ist wie zuvor.</translation>
    </message>
    <message>
        <source>Undone: %1; it is a draft again</source>
        <translation>Rückgängig: %1; es ist wieder ein Entwurf</translation>
    </message>
    <message>
        <source>Open a case first</source>
        <translation>Öffnen Sie zuerst einen Fall</translation>
    </message>
    <message>
        <source>A step is under way; wait, or stop it.</source>
        <translation>Ein Schritt läuft; warten Sie oder halten Sie ihn an.</translation>
    </message>
    <message>
        <source>A step is under way; then the structure can be created.</source>
        <translation>Ein Schritt läuft; danach lässt sich die Struktur erstellen.</translation>
    </message>
    <message>
        <source>Give the structure a name.</source>
        <translation>Geben Sie der Struktur einen Namen.</translation>
    </message>
    <message>
        <source>a structure without a name</source>
        <translation>eine Struktur ohne Namen</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Computing the draft…</source>
        <translation>Der Entwurf wird berechnet…</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>A step on the draft is being finished…</source>
        <translation>Ein Schritt am Entwurf wird beendet…</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>A structure is not finished</source>
        <translation>Eine Struktur ist nicht fertig</translation>
    </message>
    <message>
        <source>The draft of “%1” is not a structure of the case yet.</source>
        <translation>Der Entwurf von „%1“ ist noch keine Struktur des Falls.</translation>
    </message>
    <message>
        <source>It cannot be created as it is: %1</source>
        <translation>So lässt sie sich nicht erstellen: %1</translation>
    </message>
    <message>
        <source>Create</source>
        <translation>Erstellen</translation>
    </message>
    <message>
        <source>The draft is large: the 3D view shows it in cells of %1 voxels along each axis; what is created has all its voxels</source>
        <translation>Der Entwurf ist groß: Die 3D-Ansicht zeigt ihn in Zellen von %1 Voxeln entlang jeder Achse; was erstellt wird, hat alle seine Voxel</translation>
    </message>
    <message>
        <source>The structure is created when the preview is done.</source>
        <translation>Die Struktur wird angelegt, sobald die Vorschau fertig ist.</translation>
    </message>
    <message>
        <source>Discard the draft</source>
        <translation>Entwurf verwerfen</translation>
    </message>
    <message>
        <source>Discard the draft of “%1”?</source>
        <translation>Den Entwurf von „%1“ verwerfen?</translation>
    </message>
    <message>
        <source>Se&amp;gment</source>
        <translation>Se&amp;gmentierung</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::SegmentPanel</name>
    <message>
        <source>Strokes; nothing grown yet</source>
        <translation>Striche; noch nichts gewachsen</translation>
    </message>
    <message>
        <source>Nothing yet</source>
        <translation>Noch nichts</translation>
    </message>
    <message>
        <source>%1  (%2 voxels)</source>
        <translation>%1  (%2 Voxel)</translation>
    </message>
    <message>
        <source>Edit…</source>
        <translation>Bearbeiten…</translation>
    </message>
    <message>
        <source>The image that threshold, growing and the nerve tool read; an MR once it is registered</source>
        <translation>Das Bild, das Schwellwert, Wachsen und das Nervenwerkzeug lesen; ein MR, sobald es registriert ist</translation>
    </message>
    <message>
        <source>Name, such as sigmoid sinus</source>
        <translation>Name, etwa Sinus sigmoideus</translation>
    </message>
    <message>
        <source>What the structure is called; its colour and behaviour follow from it</source>
        <translation>Wie die Struktur heißt; Farbe und Verhalten folgen daraus</translation>
    </message>
    <message>
        <source>Take a structure of the case as the draft, to change it</source>
        <translation>Eine Struktur des Falls als Entwurf nehmen, um sie zu ändern</translation>
    </message>
    <message>
        <source>The case has no structure on the %1</source>
        <translation>Der Fall hat keine Struktur auf dem %1</translation>
    </message>
    <message>
        <source>Stru&amp;cture</source>
        <translation>Stru&amp;ktur</translation>
    </message>
    <message>
        <source>&amp;Image</source>
        <translation>&amp;Bild</translation>
    </message>
    <message>
        <source>The slices show what the tools work on</source>
        <translation>Die Schichten zeigen, woran die Werkzeuge arbeiten</translation>
    </message>
    <message>
        <source>The tools work on what the slices show</source>
        <translation>Die Werkzeuge arbeiten an dem, was die Schichten zeigen</translation>
    </message>
    <message>
        <source>One step, which can be undone (Shift+Return)</source>
        <translation>Ein Schritt, der sich rückgängig machen lässt (Umschalt+Eingabe)</translation>
    </message>
    <message>
        <source>The least intensity that belongs to it</source>
        <translation>Die kleinste Intensität, die dazugehört</translation>
    </message>
    <message>
        <source>The greatest intensity that belongs to it</source>
        <translation>Die größte Intensität, die dazugehört</translation>
    </message>
    <message>
        <source>Ra&amp;nge</source>
        <translation>Berei&amp;ch</translation>
    </message>
    <message>
        <source>Ra&amp;dius</source>
        <translation>Ra&amp;dius</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
    <message>
        <source>A ball reaches into the slices beside; a disk stays in the slice</source>
        <translation>Eine Kugel reicht in die Nachbarschichten; eine Scheibe bleibt in der Schicht</translation>
    </message>
    <message>
        <source>ball</source>
        <translation>Kugel</translation>
    </message>
    <message>
        <source>disk in the slice</source>
        <translation>Scheibe in der Schicht</translation>
    </message>
    <message>
        <source>S&amp;hape</source>
        <translation>&amp;Form</translation>
    </message>
    <message>
        <source>&amp;Only intensities in this range</source>
        <translation>&amp;Nur Intensitäten in diesem Bereich</translation>
    </message>
    <message>
        <source>The brush leaves other voxels as they are</source>
        <translation>Der Pinsel lässt andere Voxel, wie sie sind</translation>
    </message>
    <message>
        <source>Choose a tool. It works in the slices with the left button; with Shift the left button moves the crosshair. Esc puts it away, and the draft stays.</source>
        <translation>Wählen Sie ein Werkzeug. Es arbeitet in den Schichten mit der linken Taste; mit Umschalt bewegt die linke Taste das Fadenkreuz. Esc legt es weg, und der Entwurf bleibt.</translation>
    </message>
    <message>
        <source>All voxels of these intensities; the slices show it at once.</source>
        <translation>Alle Voxel dieser Intensitäten; die Schichten zeigen es sofort.</translation>
    </message>
    <message>
        <source>&amp;Propose</source>
        <translation>&amp;Vorschlagen</translation>
    </message>
    <message>
        <source>Range from the image&apos;s histogram</source>
        <translation>Bereich aus dem Histogramm des Bildes</translation>
    </message>
    <message>
        <source>Connected to a clic&amp;ked point</source>
        <translation>Mit einem an&amp;geklickten Punkt verbunden</translation>
    </message>
    <message>
        <source>Only what hangs together with the points that you click</source>
        <translation>Nur was mit den angeklickten Punkten zusammenhängt</translation>
    </message>
    <message>
        <source>What becomes of what is there already</source>
        <translation>Was mit dem geschieht, was schon da ist</translation>
    </message>
    <message>
        <source>replaces the draft</source>
        <translation>ersetzt den Entwurf</translation>
    </message>
    <message>
        <source>is added to it</source>
        <translation>wird ihm hinzugefügt</translation>
    </message>
    <message>
        <source>limits it: only what is in both</source>
        <translation>begrenzt ihn: nur was in beiden ist</translation>
    </message>
    <message>
        <source>Resul&amp;t</source>
        <translation>Ergebni&amp;s</translation>
    </message>
    <message>
        <source>Apply the threshold</source>
        <translation>Schwellwert anwenden</translation>
    </message>
    <message>
        <source>Drag in a slice to erase.</source>
        <translation>Ziehen Sie in einer Schicht, um zu radieren.</translation>
    </message>
    <message>
        <source>Drag in a slice to paint.</source>
        <translation>Ziehen Sie in einer Schicht, um zu malen.</translation>
    </message>
    <message>
        <source>Removes what does not hang together with the rest. Click a part in a slice to keep that alone.</source>
        <translation>Entfernt, was nicht mit dem Rest zusammenhängt. Klicken Sie einen Teil in einer Schicht an, um nur diesen zu behalten.</translation>
    </message>
    <message>
        <source>Which connected parts stay</source>
        <translation>Welche zusammenhängenden Teile bleiben</translation>
    </message>
    <message>
        <source>the largest</source>
        <translation>der größte</translation>
    </message>
    <message>
        <source>all of at least</source>
        <translation>alle ab</translation>
    </message>
    <message>
        <source>&amp;Keep</source>
        <translation>Beha&amp;lten</translation>
    </message>
    <message>
        <source>Smaller parts are removed</source>
        <translation>Kleinere Teile werden entfernt</translation>
    </message>
    <message>
        <source> mm³</source>
        <translation> mm³</translation>
    </message>
    <message>
        <source>Si&amp;ze</source>
        <translation>&amp;Größe</translation>
    </message>
    <message>
        <source>Remove islands</source>
        <translation>Inseln entfernen</translation>
    </message>
    <message>
        <source>Moves the whole surface outwards, or with a minus inwards.</source>
        <translation>Verschiebt die ganze Oberfläche nach außen oder mit Minus nach innen.</translation>
    </message>
    <message>
        <source>&amp;Margin</source>
        <translation>&amp;Rand</translation>
    </message>
    <message>
        <source>How far; below 0: inwards</source>
        <translation>Wie weit; unter 0: nach innen</translation>
    </message>
    <message>
        <source>Apply the margin</source>
        <translation>Rand anwenden</translation>
    </message>
    <message>
        <source>Rounds the surface and removes what is thinner than the width.</source>
        <translation>Rundet die Oberfläche und entfernt, was dünner als die Breite ist.</translation>
    </message>
    <message>
        <source>&amp;Width</source>
        <translation>Br&amp;eite</translation>
    </message>
    <message>
        <source>Details of this size are smoothed</source>
        <translation>Einzelheiten dieser Größe werden geglättet</translation>
    </message>
    <message>
        <source>Smooth</source>
        <translation>Glätten</translation>
    </message>
    <message>
        <source>Paint the structure in some slices of one view, with a disk; this makes the slices between them. What was painted stays.</source>
        <translation>Malen Sie die Struktur in einigen Schichten einer Ansicht, mit einer Scheibe; dies erzeugt die Schichten dazwischen. Das Gemalte bleibt.</translation>
    </message>
    <message>
        <source>Fill between slices</source>
        <translation>Zwischen Schichten füllen</translation>
    </message>
    <message>
        <source>Paint some strokes inside the structure and some beside it; the rest is decided by the image.</source>
        <translation>Malen Sie einige Striche in der Struktur und einige daneben; den Rest entscheidet das Bild.</translation>
    </message>
    <message>
        <source>What the next stroke marks</source>
        <translation>Was der nächste Strich markiert</translation>
    </message>
    <message>
        <source>inside the structure</source>
        <translation>in der Struktur</translation>
    </message>
    <message>
        <source>beside it</source>
        <translation>daneben</translation>
    </message>
    <message>
        <source>Stro&amp;kes</source>
        <translation>Str&amp;iche</translation>
    </message>
    <message>
        <source>Grow from the strokes</source>
        <translation>Aus den Strichen wachsen</translation>
    </message>
    <message>
        <source>Click along the nerve from one end, four to six points; a click between two points is put between them. Drag a point in a slice to move it.</source>
        <translation>Klicken Sie entlang des Nervs von einem Ende aus, vier bis sechs Punkte; ein Klick zwischen zwei Punkte wird zwischen sie gesetzt. Ziehen Sie einen Punkt in einer Schicht, um ihn zu bewegen.</translation>
    </message>
    <message>
        <source>Points along the nerve</source>
        <translation>Punkte entlang des Nervs</translation>
    </message>
    <message>
        <source>#</source>
        <translation>#</translation>
    </message>
    <message>
        <source>To the path</source>
        <translation>Auf den Pfad</translation>
    </message>
    <message>
        <source>What the scan shows here</source>
        <translation>Was die Aufnahme hier zeigt</translation>
    </message>
    <message>
        <source>The crosshair goes to the chosen point. Delete removes it; Alt+Up and Alt+Down change its place along the nerve</source>
        <translation>Das Fadenkreuz geht zum gewählten Punkt. Entf entfernt ihn; Alt+Auf und Alt+Ab ändern seinen Platz entlang des Nervs</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>The chosen point (Delete)</source>
        <translation>Der gewählte Punkt (Entf)</translation>
    </message>
    <message>
        <source>To the crosshair</source>
        <translation>Ins Fadenkreuz</translation>
    </message>
    <message>
        <source>Moves the chosen point to the crosshair</source>
        <translation>Bewegt den gewählten Punkt ins Fadenkreuz</translation>
    </message>
    <message>
        <source>The chosen point earlier along the nerve (Alt+Up)</source>
        <translation>Der gewählte Punkt früher entlang des Nervs (Alt+Auf)</translation>
    </message>
    <message>
        <source>The chosen point later along the nerve (Alt+Down)</source>
        <translation>Der gewählte Punkt später entlang des Nervs (Alt+Ab)</translation>
    </message>
    <message>
        <source>&amp;estimated</source>
        <translation>g&amp;eschätzt</translation>
    </message>
    <message>
        <source>From the image, along the path; else one everywhere</source>
        <translation>Aus dem Bild, entlang des Pfads; sonst überall gleich</translation>
    </message>
    <message>
        <source>Of the tube, everywhere</source>
        <translation>Der Röhre, überall</translation>
    </message>
    <message>
        <source>Add the tube to the draft</source>
        <translation>Röhre zum Entwurf hinzufügen</translation>
    </message>
    <message>
        <source>Volume of the structure as it is now, with the preview</source>
        <translation>Volumen der Struktur, wie sie jetzt ist, mit der Vorschau</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Ends what is being computed; the draft stays</source>
        <translation>Beendet, was berechnet wird; der Entwurf bleibt</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>The last step (Ctrl+Z while a tool is in use)</source>
        <translation>Der letzte Schritt (Strg+Z, solange ein Werkzeug benutzt wird)</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Wiederholen</translation>
    </message>
    <message>
        <source>Again (Ctrl+Shift+Z while a tool is in use)</source>
        <translation>Erneut (Strg+Umschalt+Z, solange ein Werkzeug benutzt wird)</translation>
    </message>
    <message>
        <source>Create structure</source>
        <translation>Struktur erstellen</translation>
    </message>
    <message>
        <source>The draft becomes a structure of the case (Return)</source>
        <translation>Der Entwurf wird eine Struktur des Falls (Eingabe)</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Drops the draft (Esc without a tool)</source>
        <translation>Verwirft den Entwurf (Esc ohne Werkzeug)</translation>
    </message>
    <message>
        <source>Keep the largest</source>
        <translation>Größten behalten</translation>
    </message>
    <message>
        <source>Removes the other pieces; a step</source>
        <translation>Entfernt die anderen Stücke; ein Schritt</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>%1 mm</source>
        <translation>%1 mm</translation>
    </message>
    <message>
        <source>Show %1</source>
        <translation>%1 zeigen</translation>
    </message>
    <message>
        <source>Work on %1</source>
        <translation>An %1 arbeiten</translation>
    </message>
    <message>
        <source>%1 pieces, %2 outside the largest</source>
        <translation>%1 Stücke, %2 außerhalb des größten</translation>
    </message>
    <message>
        <source>%1 (Ctrl+Z while a tool is in use)</source>
        <translation>%1 (Strg+Z, solange ein Werkzeug benutzt wird)</translation>
    </message>
    <message>
        <source>The last step</source>
        <translation>Der letzte Schritt</translation>
    </message>
    <message>
        <source>Undo %1</source>
        <translation>%1 rückgängig</translation>
    </message>
    <message>
        <source>%1 (Ctrl+Shift+Z while a tool is in use)</source>
        <translation>%1 (Strg+Umschalt+Z, solange ein Werkzeug benutzt wird)</translation>
    </message>
    <message>
        <source>Again</source>
        <translation>Erneut</translation>
    </message>
    <message>
        <source>Redo %1</source>
        <translation>%1 wiederholen</translation>
    </message>
    <message>
        <source>Save the changes</source>
        <translation>Änderungen speichern</translation>
    </message>
    <message>
        <source>Upper limit</source>
        <translation>Obere Grenze</translation>
    </message>
    <message>
        <source>The preview is being computed.</source>
        <translation>Die Vorschau wird berechnet.</translation>
    </message>
    <message>
        <source>Of the ball, or disk (A or [ smaller, S or ] larger)</source>
        <translation>Der Kugel oder Scheibe (A oder [ kleiner, S oder ] größer)</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::SendDialog</name>
    <message>
        <source>The &amp;MR of the case, as a series</source>
        <translation>Das &amp;MR des Falls, als Serie</translation>
    </message>
    <message>
        <source>&amp;CT, as a series</source>
        <translation>&amp;CT, als Serie</translation>
    </message>
    <message>
        <source>M&amp;R, a series each</source>
        <translation>M&amp;R, je eine Serie</translation>
    </message>
    <message>
        <source>Str&amp;uctures, as segmentations (SEG)</source>
        <translation>&amp;Strukturen, als Segmentierungen (SEG)</translation>
    </message>
    <message>
        <source>The &amp;whole scene, to be received as it is (Raw Data)</source>
        <translation>Die gan&amp;ze Szene, zu empfangen, wie sie ist (Raw Data)</translation>
    </message>
    <message>
        <source>with its &amp;note</source>
        <translation>mit der &amp;Notiz</translation>
    </message>
    <message>
        <source>with its &amp;videos, which may show or name the patient</source>
        <translation>mit den &amp;Videos, die den Patienten zeigen oder nennen können</translation>
    </message>
    <message>
        <source>with its PD&amp;Fs, which may name the patient</source>
        <translation>mit den PD&amp;Fs, die den Patienten nennen können</translation>
    </message>
    <message>
        <source>Put a&amp;ir in place of the face</source>
        <translation>Das &amp;Gesicht durch Luft ersetzen</translation>
    </message>
    <message>
        <source>Send “%1”</source>
        <translation>„%1“ senden</translation>
    </message>
    <message>
        <source>at</source>
        <translation>bei</translation>
    </message>
    <message>
        <source>In front of a plane about 50 mm behind the tip of the nose. What is segmented or drilled and the temporal bones stay; the case here does not change</source>
        <translation>Vor einer Ebene etwa 50 mm hinter der Nasenspitze. Was segmentiert oder gebohrt ist und die Felsenbeine bleiben; der Fall hier ändert sich nicht</translation>
    </message>
    <message>
        <source>What is sent of the patient</source>
        <translation>Was vom Patienten gesendet wird</translation>
    </message>
    <message>
        <source>A PACS keeps it without being able to show it; Library &gt; Receive brings back the very same case</source>
        <translation>Ein PACS bewahrt sie auf, ohne sie zeigen zu können; Bibliothek &gt; Empfangen bringt genau denselben Fall zurück</translation>
    </message>
    <message>
        <source>&amp;To:</source>
        <translation>&amp;An:</translation>
    </message>
    <message>
        <source>What:</source>
        <translation>Was:</translation>
    </message>
    <message>
        <source>&amp;Send</source>
        <translation>Sen&amp;den</translation>
    </message>
    <message>
        <source>What leaves this computer:</source>
        <translation>Was diesen Rechner verlässt:</translation>
    </message>
    <message>
        <source>Nothing is chosen.</source>
        <translation>Nichts ist gewählt.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::SeriesDialog</name>
    <message>
        <source>structures</source>
        <translation>Strukturen</translation>
    </message>
    <message>
        <source>surface</source>
        <translation>Oberfläche</translation>
    </message>
    <message>
        <source>structures on another grid</source>
        <translation>Strukturen auf einem anderen Gitter</translation>
    </message>
    <message>
        <source>structures on the grid of the %1</source>
        <translation>Strukturen auf dem Gitter des %1</translation>
    </message>
    <message>
        <source>image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>sound</source>
        <translation>heil</translation>
    </message>
    <message>
        <source>needs repair</source>
        <translation>muss repariert werden</translation>
    </message>
    <message>
        <source>cannot be used</source>
        <translation>nicht verwendbar</translation>
    </message>
    <message>
        <source>%1 × %2 × %3 mm</source>
        <translation>%1 × %2 × %3 mm</translation>
    </message>
    <message>
        <source>beside it in “%1”</source>
        <translation>daneben in „%1“</translation>
    </message>
    <message>
        <source>in “%1”</source>
        <translation>in „%1“</translation>
    </message>
    <message>
        <source>Choose a &amp;region of each image first</source>
        <translation>Zuerst einen &amp;Ausschnitt jedes Bildes wählen</translation>
    </message>
    <message>
        <source>Which series?</source>
        <translation>Welche Serie?</translation>
    </message>
    <message>
        <source>“%1” holds more than one series or volume, or structures beside it. A CT begins a case; MRs, structures and meshes go with it, or come to the open case.</source>
        <translation>„%1“ enthält mehr als eine Serie oder ein Volumen, oder Strukturen daneben. Ein CT beginnt einen Fall; MRs, Strukturen und Netze gehen mit ihm oder kommen zum offenen Fall.</translation>
    </message>
    <message>
        <source>Series</source>
        <translation>Serie</translation>
    </message>
    <message>
        <source>Images</source>
        <translation>Bilder</translation>
    </message>
    <message>
        <source>Voxel</source>
        <translation>Voxel</translation>
    </message>
    <message>
        <source>Taken</source>
        <translation>Aufgenommen</translation>
    </message>
    <message>
        <source>Position, kernel, folder</source>
        <translation>Lage, Kern, Ordner</translation>
    </message>
    <message>
        <source>Geometry</source>
        <translation>Geometrie</translation>
    </message>
    <message>
        <source>Only that region is read: a whole head then takes no more memory than the ear alone</source>
        <translation>Nur dieser Ausschnitt wird gelesen: Ein ganzer Kopf braucht dann nicht mehr Speicher als das Ohr allein</translation>
    </message>
    <message>
        <source>No case is open, and one begins with the patient&apos;s CT; tick that, too.</source>
        <translation>Kein Fall ist offen, und einer beginnt mit dem CT des Patienten; kreuzen Sie auch dieses an.</translation>
    </message>
    <message>
        <source>structures on the grid of the %1 “%2”</source>
        <translation>Strukturen auf dem Gitter von %1 „%2“</translation>
    </message>
    <message>
        <source>without a description</source>
        <translation>ohne Beschreibung</translation>
    </message>
    <message>
        <source>Nothing is ticked: tick what is to be opened. Why a series cannot be used, or what its repair would change, is in its tooltip.</source>
        <translation>Nichts ist angehakt: Haken Sie an, was geöffnet werden soll. Warum eine Serie unbrauchbar ist oder was ihre Reparatur ändern würde, steht in ihrem Tooltip.</translation>
    </message>
    <message>
        <source>Axes</source>
        <translation>Achsen</translation>
    </message>
    <message>
        <source>For a file that states wrong axes. What else can be wrong, and how the image then looks, is in Case &gt; Correct the axes…</source>
        <translation>Für eine Datei, die falsche Achsen nennt. Was sonst falsch sein kann, und wie das Bild dann aussieht, steht unter Fall &gt; Achsen korrigieren…</translation>
    </message>
    <message>
        <source>as the file states</source>
        <translation>wie die Datei sagt</translation>
    </message>
    <message>
        <source>as its image</source>
        <translation>wie sein Bild</translation>
    </message>
    <message>
        <source>It follows a correction of the image on which it was drawn</source>
        <translation>Es folgt einer Korrektur des Bildes, auf dem es gezeichnet wurde</translation>
    </message>
    <message>
        <source>It lies where it belongs, whatever is wrong with its image</source>
        <translation>Es liegt, wo es hingehört, was auch an seinem Bild falsch ist</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::SettingsDialog</name>
    <message>
        <source>Settings</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>3D view and slices stay dark: bone is the brightest there</source>
        <translation>3D-Ansicht und Schichten bleiben dunkel: Knochen ist dort am hellsten</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Dunkel</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Hell</translation>
    </message>
    <message>
        <source>&amp;Theme:</source>
        <translation>&amp;Design:</translation>
    </message>
    <message>
        <source> %</source>
        <translation> %</translation>
    </message>
    <message>
        <source>Of the letters of menus, panels and dialogs</source>
        <translation>Der Schrift von Menüs, Bereichen und Dialogen</translation>
    </message>
    <message>
        <source>&amp;Letters:</source>
        <translation>S&amp;chrift:</translation>
    </message>
    <message>
        <source>Another fold&amp;er…</source>
        <translation>Anderer O&amp;rdner…</translation>
    </message>
    <message>
        <source>From the next start on, for the command too; --library and PETROUS_LIBRARY go first. Nothing is moved.</source>
        <translation>Vom nächsten Start an, auch für den Befehl; --library und PETROUS_LIBRARY gehen vor. Nichts wird verschoben.</translation>
    </message>
    <message>
        <source>Library:</source>
        <translation>Bibliothek:</translation>
    </message>
    <message>
        <source>named by PETROUS_LIBRARY, which goes first</source>
        <translation>von PETROUS_LIBRARY genannt, das vorgeht</translation>
    </message>
    <message>
        <source>from the next start on: %1</source>
        <translation>vom nächsten Start an: %1</translation>
    </message>
    <message>
        <source>Folder of the library</source>
        <translation>Ordner der Bibliothek</translation>
    </message>
    <message>
        <source>Library</source>
        <translation>Bibliothek</translation>
    </message>
    <message>
        <source>Use the library in %1 from the next start on?</source>
        <translation>Die Bibliothek in %1 vom nächsten Start an verwenden?</translation>
    </message>
    <message>
        <source>It has 1 case.</source>
        <translation>Sie hat 1 Fall.</translation>
    </message>
    <message>
        <source>It has %1 cases.</source>
        <translation>Sie hat %1 Fälle.</translation>
    </message>
    <message>
        <source>It is empty: a new library begins there.</source>
        <translation>Er ist leer: Dort beginnt eine neue Bibliothek.</translation>
    </message>
    <message>
        <source>It has other files and no cases: a new library begins among them.</source>
        <translation>Er hat andere Dateien und keine Fälle: Zwischen ihnen beginnt eine neue Bibliothek.</translation>
    </message>
    <message>
        <source>Nothing is moved or copied: the cases in %1 stay there. Archive and Restore take a case along.</source>
        <translation>Nichts wird verschoben oder kopiert: Die Fälle in %1 bleiben dort. Archivieren und Wiederherstellen nehmen einen Fall mit.</translation>
    </message>
    <message>
        <source>&amp;Use it</source>
        <translation>&amp;Verwenden</translation>
    </message>
    <message>
        <source>System: German where the computer&apos;s language is German, otherwise English</source>
        <translation>System: Deutsch, wo die Sprache des Rechners Deutsch ist, sonst Englisch</translation>
    </message>
    <message>
        <source>System</source>
        <translation>System</translation>
    </message>
    <message>
        <source>La&amp;nguage from the next start on:</source>
        <translation>S&amp;prache ab dem nächsten Start:</translation>
    </message>
    <message>
        <source>&amp;Restore defaults</source>
        <translation>Sta&amp;ndardwerte</translation>
    </message>
    <message>
        <source>Theme, letters and language as they were before any choice</source>
        <translation>Design, Schrift und Sprache, wie sie vor jeder Wahl waren</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ShareController</name>
    <message>
        <source>One at a time: something is being read or written already</source>
        <translation>Eines nach dem anderen: Es wird schon etwas gelesen oder geschrieben</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>%1: %2; no program is set up to open it</source>
        <translation>%1: %2; es ist kein Programm eingerichtet, es zu öffnen</translation>
    </message>
    <message>
        <source>Writing the report</source>
        <translation>Der Bericht wird geschrieben</translation>
    </message>
    <message>
        <source>The report is written</source>
        <translation>Der Bericht ist geschrieben</translation>
    </message>
    <message>
        <source>Drawing the picture</source>
        <translation>Das Bild wird gezeichnet</translation>
    </message>
    <message>
        <source>The picture is written</source>
        <translation>Das Bild ist geschrieben</translation>
    </message>
    <message>
        <source>Drawing the film</source>
        <translation>Der Film wird gezeichnet</translation>
    </message>
    <message>
        <source>The film is written</source>
        <translation>Der Film ist geschrieben</translation>
    </message>
    <message>
        <source>Read what stands in it as it was typed, for names: %1</source>
        <translation>Lesen Sie auf Namen, was darin steht, wie es eingegeben wurde: %1</translation>
    </message>
    <message>
        <source>soft tissue</source>
        <translation>Weichgewebe</translation>
    </message>
    <message>
        <source>Not drawn, as the flight goes through it: %1</source>
        <translation>Nicht gezeichnet, da der Flug hindurchgeht: %1</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ShareDialog</name>
    <message>
        <source>&amp;File:</source>
        <translation>Da&amp;tei:</translation>
    </message>
    <message>
        <source>Give the file a name.</source>
        <translation>Geben Sie der Datei einen Namen.</translation>
    </message>
    <message>
        <source>There is no such folder.</source>
        <translation>Diesen Ordner gibt es nicht.</translation>
    </message>
    <message>
        <source>As in the 3D view</source>
        <translation>Wie in der 3D-Ansicht</translation>
    </message>
    <message>
        <source>White</source>
        <translation>Weiß</translation>
    </message>
    <message>
        <source>White saves ink, and goes with the paper</source>
        <translation>Weiß spart Tinte und passt zum Papier</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::SharePanel</name>
    <message>
        <source>&amp;Report…</source>
        <translation>&amp;Bericht…</translation>
    </message>
    <message>
        <source>The plan as PDF or HTML: pictures, distances, strokes, measurements (Ctrl+P)</source>
        <translation>Der Plan als PDF oder HTML: Bilder, Abstände, Bohrzüge, Messungen (Strg+P)</translation>
    </message>
    <message>
        <source>&amp;Picture…</source>
        <translation>B&amp;ild…</translation>
    </message>
    <message>
        <source>The 3D view as a PNG for print, with scale bar and side</source>
        <translation>Die 3D-Ansicht als PNG für den Druck, mit Maßstab und Seite</translation>
    </message>
    <message>
        <source>&amp;Film…</source>
        <translation>&amp;Film…</translation>
    </message>
    <message>
        <source>Once around the patient, or a flight along a canal or nerve</source>
        <translation>Einmal um den Patienten oder ein Flug entlang eines Kanals oder Nervs</translation>
    </message>
    <message>
        <source>Objects of the case for other programs</source>
        <translation>Objekte des Falls für andere Programme</translation>
    </message>
    <message>
        <source>Object</source>
        <translation>Objekt</translation>
    </message>
    <message>
        <source>Written as</source>
        <translation>Geschrieben als</translation>
    </message>
    <message>
        <source>&amp;Export…</source>
        <translation>E&amp;xportieren…</translation>
    </message>
    <message>
        <source>The chosen object as a file for other programs (Return, double click)</source>
        <translation>Das gewählte Objekt als Datei für andere Programme (Eingabe, Doppelklick)</translation>
    </message>
    <message>
        <source>Archi&amp;ve…</source>
        <translation>&amp;Archivieren…</translation>
    </message>
    <message>
        <source>The case in one file; what is in it, and what may tell who the patient is, is shown before</source>
        <translation>Der Fall in einer Datei; was darin ist und was verraten kann, wer der Patient ist, wird vorher gezeigt</translation>
    </message>
    <message>
        <source>&amp;Send to a node…</source>
        <translation>An einen Knoten &amp;senden…</translation>
    </message>
    <message>
        <source>To a DICOM node; what leaves is shown before</source>
        <translation>An einen DICOM-Knoten; was hinausgeht, wird vorher gezeigt</translation>
    </message>
    <message>
        <source>For other programs</source>
        <translation>Für andere Programme</translation>
    </message>
    <message>
        <source>Before the case leaves, a report says what is in it, what stays here, and what may tell who the patient is.</source>
        <translation>Bevor der Fall hinausgeht, sagt ein Bericht, was darin ist, was hier bleibt und was verraten kann, wer der Patient ist.</translation>
    </message>
    <message>
        <source>The whole case</source>
        <translation>Der ganze Fall</translation>
    </message>
    <message>
        <source>To look at</source>
        <translation>Zum Ansehen</translation>
    </message>
    <message>
        <source>voxels, DICOM</source>
        <translation>Voxel, DICOM</translation>
    </message>
    <message>
        <source>surface</source>
        <translation>Oberfläche</translation>
    </message>
    <message>
        <source>All structures</source>
        <translation>Alle Strukturen</translation>
    </message>
    <message>
        <source>labels, DICOM</source>
        <translation>Labels, DICOM</translation>
    </message>
    <message>
        <source>%1 after drilling</source>
        <translation>%1 nach dem Bohren</translation>
    </message>
    <message>
        <source>Bone after drilling</source>
        <translation>Knochen nach dem Bohren</translation>
    </message>
    <message>
        <source>What is left of each voxel</source>
        <translation>Was von jedem Voxel übrig ist</translation>
    </message>
    <message>
        <source>mask</source>
        <translation>Maske</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::SliceColumn</name>
    <message>
        <source>Drag: move the crosshair.  Wheel: scroll.  Right drag: grey window.
Ctrl+wheel: zoom.  Middle drag: move.  Double click (E): enlarge, and back.
Red and hatched: drilled away.</source>
        <translation>Ziehen: Fadenkreuz bewegen.  Rad: blättern.  Rechts ziehen: Grauwertfenster.
Strg+Rad: zoomen.  Mitte ziehen: bewegen.  Doppelklick (E): vergrößern und zurück.
Rot und schraffiert: weggebohrt.</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::SliceController</name>
    <message>
        <source>S&amp;lices</source>
        <translation>&amp;Schichten</translation>
    </message>
    <message>
        <source>&amp;Axial, coronal, sagittal</source>
        <translation>&amp;Axial, koronar, sagittal</translation>
    </message>
    <message>
        <source>Along the patient&apos;s axes; puts turned planes back</source>
        <translation>Entlang der Achsen des Patienten; stellt gedrehte Ebenen zurück</translation>
    </message>
    <message>
        <source>&amp;Pöschl and Stenvers planes</source>
        <translation>Ebenen nach &amp;Pöschl und Stenvers</translation>
    </message>
    <message>
        <source>Upright, at 45° across and along the petrous bone of the ear&apos;s side, in place of the sagittal and the coronal slice</source>
        <translation>Aufrecht, unter 45° quer und entlang der Pyramide des Felsenbeins der Ohrseite, anstelle der sagittalen und der koronaren Schicht</translation>
    </message>
    <message>
        <source>Along the too&amp;l</source>
        <translation>Entlang des &amp;Werkzeugs</translation>
    </message>
    <message>
        <source>One plane across the tool&apos;s axis and two along it, which follow the tool; without a tool in use, along the line of sight</source>
        <translation>Eine Ebene quer zur Achse des Werkzeugs und zwei entlang, die dem Werkzeug folgen; ohne Werkzeug entlang der Blickrichtung</translation>
    </message>
    <message>
        <source>Turned by &amp;hand</source>
        <translation>Von &amp;Hand gedreht</translation>
    </message>
    <message>
        <source>Ctrl+drag in a slice turns the other two planes, Ctrl+arrow keys tilt it</source>
        <translation>Strg+Ziehen in einer Schicht dreht die anderen beiden Ebenen, Strg+Pfeiltasten kippen sie</translation>
    </message>
    <message>
        <source>&amp;Grey window</source>
        <translation>&amp;Grauwertfenster</translation>
    </message>
    <message>
        <source>%1: W %2  L %3</source>
        <translation>%1: B %2  Z %3</translation>
    </message>
    <message>
        <source>&amp;Thin slice</source>
        <translation>&amp;Dünne Schicht</translation>
    </message>
    <message>
        <source>Without a slab</source>
        <translation>Ohne Schichtpaket</translation>
    </message>
    <message>
        <source>Slab: &amp;brightest (MIP)</source>
        <translation>Schichtpaket: he&amp;llste (MIP)</translation>
    </message>
    <message>
        <source>Maximum intensity projection through a layer about the slice</source>
        <translation>Maximumintensitätsprojektion durch ein Paket um die Schicht</translation>
    </message>
    <message>
        <source>Slab: &amp;darkest (MinIP)</source>
        <translation>Schichtpaket: d&amp;unkelste (MinIP)</translation>
    </message>
    <message>
        <source>Minimum intensity projection: air cells</source>
        <translation>Minimumintensitätsprojektion: Luftzellen</translation>
    </message>
    <message>
        <source>Slab: m&amp;ean</source>
        <translation>Schichtpaket: &amp;Mittel</translation>
    </message>
    <message>
        <source>As a thicker slice: less noise</source>
        <translation>Wie eine dickere Schicht: weniger Rauschen</translation>
    </message>
    <message>
        <source>&amp;Next projection</source>
        <translation>&amp;Nächste Projektion</translation>
    </message>
    <message>
        <source>Thin, MIP, MinIP, mean in turn</source>
        <translation>Dünn, MIP, MinIP, Mittel im Wechsel</translation>
    </message>
    <message>
        <source>Thi&amp;cker slab</source>
        <translation>Schichtpaket dic&amp;ker</translation>
    </message>
    <message>
        <source>1, 2, 3, 5, 8, 12, 20, 30 or 50 mm</source>
        <translation>1, 2, 3, 5, 8, 12, 20, 30 oder 50 mm</translation>
    </message>
    <message>
        <source>Thinne&amp;r slab</source>
        <translation>Schichtpaket dünn&amp;er</translation>
    </message>
    <message>
        <source>50, 30, 20, 12, 8, 5, 3, 2 or 1 mm, then the thin slice</source>
        <translation>50, 30, 20, 12, 8, 5, 3, 2 oder 1 mm, dann die dünne Schicht</translation>
    </message>
    <message>
        <source>&amp;Zoom slices together</source>
        <translation>Schichten gemeinsam &amp;zoomen</translation>
    </message>
    <message>
        <source>A slice that is zoomed takes the others along, to one scale</source>
        <translation>Eine gezoomte Schicht nimmt die anderen mit, auf einen Maßstab</translation>
    </message>
    <message>
        <source>Zoom &amp;with the 3D view</source>
        <translation>Mit der 3D-Ansicht z&amp;oomen</translation>
    </message>
    <message>
        <source>The slices have the scale of the 3D view where it turns about</source>
        <translation>Die Schichten haben den Maßstab der 3D-Ansicht an deren Drehpunkt</translation>
    </message>
    <message>
        <source>Which ear it is, is not known: choose it with the planes in the panel Slices, or state the side (Case &gt; Side)</source>
        <translation>Welches Ohr es ist, ist nicht bekannt: mit den Ebenen im Bereich Schichten wählen oder die Seite angeben (Fall &gt; Seite)</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::SliceView</name>
    <message>
        <source>MIP</source>
        <translation>MIP</translation>
    </message>
    <message>
        <source>MinIP</source>
        <translation>MinIP</translation>
    </message>
    <message>
        <source>Mean</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source>%1 %2 mm</source>
        <translation>%1 %2 mm</translation>
    </message>
    <message>
        <source>interpolated slice: not measured here</source>
        <translation>interpolierte Schicht: hier nicht gemessen</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::SlicesPanel</name>
    <message>
        <source>Bone</source>
        <translation>Knochen</translation>
    </message>
    <message>
        <source>Temporal bone</source>
        <translation>Felsenbein</translation>
    </message>
    <message>
        <source>Soft tissue</source>
        <translation>Weichteile</translation>
    </message>
    <message>
        <source>All tissue</source>
        <translation>Gesamtes Gewebe</translation>
    </message>
    <message>
        <source>Dark half</source>
        <translation>Dunkle Hälfte</translation>
    </message>
    <message>
        <source>Where the three slices lie. Ctrl+drag in a slice turns the other two about the crosshair</source>
        <translation>Wo die drei Schichten liegen. Strg+Ziehen in einer Schicht dreht die anderen beiden um das Fadenkreuz</translation>
    </message>
    <message>
        <source>Axial, coronal, sagittal</source>
        <translation>Axial, koronar, sagittal</translation>
    </message>
    <message>
        <source>Pöschl and Stenvers, left ear</source>
        <translation>Pöschl und Stenvers, linkes Ohr</translation>
    </message>
    <message>
        <source>Pöschl and Stenvers, right ear</source>
        <translation>Pöschl und Stenvers, rechtes Ohr</translation>
    </message>
    <message>
        <source>Along the tool</source>
        <translation>Entlang des Werkzeugs</translation>
    </message>
    <message>
        <source>Turned by hand</source>
        <translation>Von Hand gedreht</translation>
    </message>
    <message>
        <source>&amp;Planes</source>
        <translation>&amp;Ebenen</translation>
    </message>
    <message>
        <source>Grey windows by name: those of the image that is seen, and your own</source>
        <translation>Grauwertfenster nach Namen: die des sichtbaren Bildes und Ihre eigenen</translation>
    </message>
    <message>
        <source>Keep…</source>
        <translation>Behalten…</translation>
    </message>
    <message>
        <source>Keeps width and level under a name of yours</source>
        <translation>Behält Breite und Zentrum unter einem eigenen Namen</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Takes your own window out of the list</source>
        <translation>Nimmt Ihr eigenes Fenster aus der Liste</translation>
    </message>
    <message>
        <source>&amp;Grey window</source>
        <translation>&amp;Grauwertfenster</translation>
    </message>
    <message>
        <source>From black to white; right drag in a slice changes it too</source>
        <translation>Von Schwarz bis Weiß; rechts Ziehen in einer Schicht ändert es auch</translation>
    </message>
    <message>
        <source>In the middle between black and white</source>
        <translation>In der Mitte zwischen Schwarz und Weiß</translation>
    </message>
    <message>
        <source>&amp;Width</source>
        <translation>&amp;Breite</translation>
    </message>
    <message>
        <source>&amp;Level</source>
        <translation>&amp;Zentrum</translation>
    </message>
    <message>
        <source>What a slice shows of the layer about it (Ctrl+J)</source>
        <translation>Was eine Schicht vom Paket um sie zeigt (Strg+J)</translation>
    </message>
    <message>
        <source>Thin slice</source>
        <translation>Dünne Schicht</translation>
    </message>
    <message>
        <source>Brightest (MIP)</source>
        <translation>Hellste (MIP)</translation>
    </message>
    <message>
        <source>Darkest (MinIP)</source>
        <translation>Dunkelste (MinIP)</translation>
    </message>
    <message>
        <source>Mean</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>&amp;Slab</source>
        <translation>&amp;Paket</translation>
    </message>
    <message>
        <source>&amp;Thickness</source>
        <translation>&amp;Dicke</translation>
    </message>
    <message>
        <source>&amp;Zoom slices together</source>
        <translation>Schichten ge&amp;meinsam zoomen</translation>
    </message>
    <message>
        <source>A slice that is zoomed (Ctrl+wheel, + and -) takes the others along, to one scale</source>
        <translation>Eine gezoomte Schicht (Strg+Rad, + und -) nimmt die anderen mit, auf einen Maßstab</translation>
    </message>
    <message>
        <source>Zoom with the &amp;3D view</source>
        <translation>Mit der &amp;3D-Ansicht zoomen</translation>
    </message>
    <message>
        <source>The slices have the scale that the 3D view has where it turns about</source>
        <translation>Die Schichten haben den Maßstab, den die 3D-Ansicht an ihrem Drehpunkt hat</translation>
    </message>
    <message>
        <source>Keep the grey window</source>
        <translation>Grauwertfenster behalten</translation>
    </message>
    <message>
        <source>Name of the window of width %1 and level %2:</source>
        <translation>Name des Fensters mit Breite %1 und Zentrum %2:</translation>
    </message>
    <message>
        <source>Of the layer, mm (Shift+J thicker, Ctrl+Shift+J thinner; or Ctrl+] and Ctrl+[)</source>
        <translation>Des Pakets, mm (Umschalt+J dicker, Strg+Umschalt+J dünner; auch Strg+] und Strg+[)</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::StartPage</name>
    <message>
        <source>changed %1</source>
        <translation>geändert %1</translation>
    </message>
    <message>
        <source>Recent cases</source>
        <translation>Letzte Fälle</translation>
    </message>
    <message>
        <source>Drop a folder of DICOM here, or choose File &gt; Open DICOM…</source>
        <translation>Ziehen Sie einen DICOM-Ordner hierher oder wählen Sie Datei &gt; DICOM öffnen…</translation>
    </message>
    <message>
        <source>A CT of the temporal bone becomes a case at once. NRRD, NIfTI and MetaImage files work too.
Nothing leaves this computer.</source>
        <translation>Ein CT des Felsenbeins wird sofort ein Fall. Dateien in NRRD, NIfTI und MetaImage gehen auch.
Nichts verlässt diesen Rechner.</translation>
    </message>
    <message>
        <source>Make the sample patient</source>
        <translation>Musterpatienten erzeugen</translation>
    </message>
    <message>
        <source>Computes an artificial right temporal bone (0.3 mm voxels) and opens it</source>
        <translation>Berechnet ein künstliches rechtes Felsenbein (Voxel von 0,3 mm) und öffnet es</translation>
    </message>
    <message>
        <source>Open DICOM…</source>
        <translation>DICOM öffnen…</translation>
    </message>
    <message>
        <source>A folder of CT slices: a new case</source>
        <translation>Ein Ordner von CT-Schichten: ein neuer Fall</translation>
    </message>
    <message>
        <source>Open case…</source>
        <translation>Fall öffnen…</translation>
    </message>
    <message>
        <source>The list of all cases, with a search</source>
        <translation>Die Liste aller Fälle, mit Suche</translation>
    </message>
    <message>
        <source>Restore…</source>
        <translation>Wiederherstellen…</translation>
    </message>
    <message>
        <source>Brings the case of an archive (.petrous) to the library and opens it</source>
        <translation>Bringt den Fall eines Archivs (.petrous) in die Bibliothek und öffnet ihn</translation>
    </message>
    <message>
        <source>The cases cannot be listed: %1</source>
        <translation>Die Fälle lassen sich nicht auflisten: %1</translation>
    </message>
    <message>
        <source>The case “%1” is no longer in the library %2.</source>
        <translation>Der Fall „%1“ ist nicht mehr in der Bibliothek %2.</translation>
    </message>
    <message>
        <source>The case “%1” cannot be opened: the folder %2 is gone. Is its disk connected?</source>
        <translation>Der Fall „%1“ lässt sich nicht öffnen: Der Ordner %2 ist weg. Ist die Platte angeschlossen?</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::StructureEditor</name>
    <message>
        <source>Colour; a window of colours opens</source>
        <translation>Farbe; ein Fenster mit Farben öffnet sich</translation>
    </message>
    <message>
        <source>Colour</source>
        <translation>Farbe</translation>
    </message>
    <message>
        <source>&amp;Preset</source>
        <translation>&amp;Vorgabe</translation>
    </message>
    <message>
        <source>Dr&amp;illed as</source>
        <translation>&amp;Gebohrt als</translation>
    </message>
    <message>
        <source>&amp;Warn</source>
        <translation>&amp;Warnen</translation>
    </message>
    <message>
        <source>Sti&amp;ffness</source>
        <translation>&amp;Steifigkeit</translation>
    </message>
    <message>
        <source>Where structures overlap, the one with the lowest number has the voxel; lumens come last</source>
        <translation>Wo Strukturen sich überlappen, hat die mit der kleinsten Zahl das Voxel; Lumina kommen zuletzt</translation>
    </message>
    <message>
        <source>Priorit&amp;y</source>
        <translation>Vo&amp;rrang</translation>
    </message>
    <message>
        <source> %</source>
        <translation> %</translation>
    </message>
    <message>
        <source>Opacity</source>
        <translation>Deckkraft</translation>
    </message>
    <message>
        <source>&amp;Opacity</source>
        <translation>&amp;Deckkraft</translation>
    </message>
    <message>
        <source>Colour, material, warning distance and order of a kind of structure; marks stay as they are</source>
        <translation>Farbe, Material, Warnabstand und Reihenfolge einer Art von Struktur; Markierungen bleiben, wie sie sind</translation>
    </message>
    <message>
        <source>Bone, by its density</source>
        <translation>Knochen, nach seiner Dichte</translation>
    </message>
    <message>
        <source>differ: </source>
        <translation>verschieden: </translation>
    </message>
    <message>
        <source>Soft tissue, as where nothing is drawn</source>
        <translation>Weichgewebe, wie wo nichts gezeichnet ist</translation>
    </message>
    <message>
        <source>Opacity; of a lumen, how much it tints what is around it; of soft tissue, a factor of that of its function</source>
        <translation>Deckkraft; eines Lumens: wie sehr es tönt, was um es ist; des Weichgewebes: ein Faktor der Deckkraft seiner Funktion</translation>
    </message>
    <message>
        <source>The presets are rigid: no stiffness of these structures was measured under a burr. Below are values derived from published moduli</source>
        <translation>Die Vorgaben sind starr: Von diesen Strukturen wurde keine Steifigkeit unter einem Fräser gemessen. Darunter stehen Werte, die aus veröffentlichten Moduln abgeleitet sind</translation>
    </message>
    <message>
        <source>As soft tissue</source>
        <translation>Wie Weichgewebe</translation>
    </message>
    <message>
        <source>Stiffness of a kind of soft tissue, derived from published moduli: each with its range and how certain it is</source>
        <translation>Steifigkeit einer Art von Weichgewebe, aus veröffentlichten Moduln abgeleitet: jede mit ihrem Bereich und wie sicher sie ist</translation>
    </message>
    <message>
        <source>%1: %2 N/mm (%3 to %4), %5</source>
        <translation>%1: %2 N/mm (%3 bis %4), %5</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::StructuresModel</name>
    <message>
        <source>Nerves</source>
        <translation>Nerven</translation>
    </message>
    <message>
        <source>Vessels</source>
        <translation>Gefäße</translation>
    </message>
    <message>
        <source>Ossicles</source>
        <translation>Gehörknöchelchen</translation>
    </message>
    <message>
        <source>Inner ear</source>
        <translation>Innenohr</translation>
    </message>
    <message>
        <source>Dura</source>
        <translation>Dura</translation>
    </message>
    <message>
        <source>Lumens</source>
        <translation>Lumina</translation>
    </message>
    <message>
        <source>Meshes</source>
        <translation>Netze</translation>
    </message>
    <message>
        <source>Other structures</source>
        <translation>Andere Strukturen</translation>
    </message>
    <message>
        <source>1 structure</source>
        <translation>1 Struktur</translation>
    </message>
    <message>
        <source>%1 structures</source>
        <translation>%1 Strukturen</translation>
    </message>
    <message>
        <source>1 mesh</source>
        <translation>1 Netz</translation>
    </message>
    <message>
        <source>%1 meshes</source>
        <translation>%1 Netze</translation>
    </message>
    <message>
        <source>%1; %2 shown</source>
        <translation>%1; %2 gezeigt</translation>
    </message>
    <message>
        <source>Tissue</source>
        <translation>Gewebe</translation>
    </message>
    <message>
        <source>Bone</source>
        <translation>Knochen</translation>
    </message>
    <message>
        <source>touched</source>
        <translation>berührt</translation>
    </message>
    <message>
        <source>Not felt: %1</source>
        <translation>Nicht gefühlt: %1</translation>
    </message>
    <message>
        <source>%1 (not on the %2)</source>
        <translation>%1 (nicht auf dem %2)</translation>
    </message>
    <message>
        <source>%1, colour %2, %3</source>
        <translation>%1, Farbe %2, %3</translation>
    </message>
    <message>
        <source>shown</source>
        <translation>gezeigt</translation>
    </message>
    <message>
        <source>hidden</source>
        <translation>verborgen</translation>
    </message>
    <message>
        <source>%1 is nowhere on the %2, and neither drawn nor felt nor warned of: %3</source>
        <translation>%1 ist nirgends auf dem %2 und wird weder gezeichnet noch gefühlt, noch wird davor gewarnt: %3</translation>
    </message>
    <message>
        <source>The %1 itself, where no structure is</source>
        <translation>Das %1 selbst, wo keine Struktur ist</translation>
    </message>
    <message>
        <source>%1 (a space without tissue)</source>
        <translation>%1 (ein Raum ohne Gewebe)</translation>
    </message>
    <message>
        <source>The mesh is being measured</source>
        <translation>Das Netz wird vermessen</translation>
    </message>
    <message>
        <source>open</source>
        <translation>eröffnet</translation>
    </message>
    <message>
        <source>No volume: the mesh is open, its surface ends at %1 edge</source>
        <translation>Kein Volumen: Das Netz ist offen, seine Oberfläche endet an %1 Kante</translation>
    </message>
    <message>
        <source>No volume: the mesh is open, its surface ends at %1 edges</source>
        <translation>Kein Volumen: Das Netz ist offen, seine Oberfläche endet an %1 Kanten</translation>
    </message>
    <message>
        <source>%1 mm³</source>
        <translation>%1 mm³</translation>
    </message>
    <message>
        <source>Volume, mm³</source>
        <translation>Volumen, mm³</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>Its check boxes are those of all of them</source>
        <translation>Seine Kästchen gelten für alle davon</translation>
    </message>
    <message>
        <source>Structure</source>
        <translation>Struktur</translation>
    </message>
    <message>
        <source>Volume</source>
        <translation>Volumen</translation>
    </message>
    <message>
        <source>Name and colour: click the colour to change it</source>
        <translation>Name und Farbe: Ein Klick auf die Farbe ändert sie</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>Zeigen</translation>
    </message>
    <message>
        <source>Drawn in 3D and outlined in the slices</source>
        <translation>In 3D gezeichnet und in den Schichten umrandet</translation>
    </message>
    <message>
        <source>Touch</source>
        <translation>Fühlen</translation>
    </message>
    <message>
        <source>Felt by the burr: part of the tissue it rests on</source>
        <translation>Von der Fräse gefühlt: Teil des Gewebes, auf dem sie liegt</translation>
    </message>
    <message>
        <source>Drill</source>
        <translation>Bohren</translation>
    </message>
    <message>
        <source>Taken by the drill; without the mark the drill leaves it whole</source>
        <translation>Wird gebohrt; ohne das Häkchen lässt der Bohrer es heil</translation>
    </message>
    <message>
        <source>Warn</source>
        <translation>Warnen</translation>
    </message>
    <message>
        <source>How near a burr may come before it is warned of, mm; 0: no warning. Double click to change</source>
        <translation>Wie nahe eine Fräse kommen darf, bevor gewarnt wird, mm; 0: keine Warnung. Doppelklick zum Ändern</translation>
    </message>
    <message>
        <source>Soft tissue</source>
        <translation>Weichgewebe</translation>
    </message>
    <message>
        <source>%1 (not drawn)</source>
        <translation>%1 (nicht gezeichnet)</translation>
    </message>
    <message>
        <source>What is neither bone nor a structure, in 3D alone: it is air to the hand and the drill</source>
        <translation>Was weder Knochen noch eine Struktur ist, nur in 3D: Für Hand und Bohrer ist es Luft</translation>
    </message>
    <message>
        <source>Not drawn: %1</source>
        <translation>Nicht gezeichnet: %1</translation>
    </message>
    <message>
        <source>What lies below the surface threshold and is no structure, in 3D alone: it is air to the hand and the drill</source>
        <translation>Was unter der Oberflächenschwelle liegt und keine Struktur ist, nur in 3D: Für Hand und Bohrer ist es Luft</translation>
    </message>
    <message>
        <source>Tool</source>
        <translation>Werkzeug</translation>
    </message>
    <message>
        <source>From the burr&apos;s ball, or the instrument, to the structure&apos;s surface</source>
        <translation>Von der Kugel der Fräse oder vom Instrument zur Oberfläche der Struktur</translation>
    </message>
    <message>
        <source>%1 (MR moved since)</source>
        <translation>%1 (MR seither bewegt)</translation>
    </message>
    <message>
        <source>%1 stays where it was made: %2</source>
        <translation>%1 bleibt, wo es gemacht wurde: %2</translation>
    </message>
    <message>
        <source>Drilled: %1</source>
        <translation>Abgetragen: %1</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>%1 (%2 of %3)</source>
        <translation>%1 (%2 von %3)</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::StructuresPanel</name>
    <message>
        <source>Search names, presets and kinds (/)</source>
        <translation>Name, Vorgabe, Art (/)</translation>
    </message>
    <message>
        <source>Search structures</source>
        <translation>Strukturen suchen</translation>
    </message>
    <message>
        <source>Only this</source>
        <translation>Nur dies</translation>
    </message>
    <message>
        <source>Shows the selected ones alone (Shift+Space, or Alt and a click on a check box); again: what was shown before</source>
        <translation>Zeigt nur die ausgewählten (Umschalt+Leertaste oder Alt und Klick auf ein Kästchen); erneut: was vorher gezeigt wurde</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>Zeigen</translation>
    </message>
    <message>
        <source>Shows the selected ones</source>
        <translation>Zeigt die ausgewählten</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>Verbergen</translation>
    </message>
    <message>
        <source>Hides the selected ones</source>
        <translation>Verbirgt die ausgewählten</translation>
    </message>
    <message>
        <source>Structures</source>
        <translation>Strukturen</translation>
    </message>
    <message>
        <source>&amp;Colour…</source>
        <translation>&amp;Farbe…</translation>
    </message>
    <message>
        <source>&amp;Properties</source>
        <translation>&amp;Eigenschaften</translation>
    </message>
    <message>
        <source>&amp;Only this, or as before</source>
        <translation>&amp;Nur dies oder wie zuvor</translation>
    </message>
    <message>
        <source>&amp;Show or hide</source>
        <translation>&amp;Zeigen oder verbergen</translation>
    </message>
    <message>
        <source>&amp;Rename…</source>
        <translation>&amp;Umbenennen…</translation>
    </message>
    <message>
        <source>Re&amp;move from the case</source>
        <translation>Aus dem Fall entfe&amp;rnen</translation>
    </message>
    <message>
        <source>Nothing is selected</source>
        <translation>Nichts ist ausgewählt</translation>
    </message>
    <message>
        <source>%1 selected</source>
        <translation>%1 ausgewählt</translation>
    </message>
    <message>
        <source>Colour tissue by its thickness over %1</source>
        <translation>Gewebe nach seiner Dicke über %1 färben</translation>
    </message>
    <message>
        <source>Colour bone by its thickness over %1</source>
        <translation>Knochen nach seiner Dicke über %1 färben</translation>
    </message>
    <message>
        <source>S&amp;urface threshold</source>
        <translation>&amp;Oberflächenschwelle</translation>
    </message>
    <message>
        <source>&amp;Bone threshold</source>
        <translation>&amp;Knochenschwelle</translation>
    </message>
    <message>
        <source>The surface is where the MR gets brighter than this, in its own unit</source>
        <translation>Die Oberfläche ist, wo das MR heller als dies wird, in seiner eigenen Einheit</translation>
    </message>
    <message>
        <source>Bone is what is denser than this, in Hounsfield units (HU)</source>
        <translation>Knochen ist, was dichter als dies ist, in Hounsfield-Einheiten (HU)</translation>
    </message>
    <message>
        <source>Bone is what is denser than this, in the image&apos;s own unit: it is not in Hounsfield units</source>
        <translation>Knochen ist, was dichter als dies ist, in der eigenen Einheit des Bildes: Es ist nicht in Hounsfield-Einheiten</translation>
    </message>
    <message>
        <source>&amp;Find a structure</source>
        <translation>Eine Struktur &amp;suchen</translation>
    </message>
    <message>
        <source>Correct the &amp;axes of its file…</source>
        <translation>&amp;Achsen seiner Datei korrigieren…</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::SurgeonWindow</name>
    <message>
        <source>Surgeon&apos;s window — Petrous</source>
        <translation>Fenster des Chirurgen — Petrous</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ThicknessController</name>
    <message>
        <source>Choose a structure in the list (F9) first</source>
        <translation>Wählen Sie zuerst eine Struktur in der Liste (F9)</translation>
    </message>
    <message>
        <source>The bone over %1 is being measured: %2 % (F6 stops it)</source>
        <translation>Der Knochen über %1 wird vermessen: %2 % (F6 hält an)</translation>
    </message>
    <message>
        <source>Measuring the thickness was stopped</source>
        <translation>Das Messen der Dicke wurde angehalten</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ThicknessLegend</name>
    <message>
        <source>Measuring over %1, F6 stops</source>
        <translation>Messung über %1, F6 hält an</translation>
    </message>
    <message>
        <source>Tissue over %1, mm</source>
        <translation>Gewebe über %1, mm</translation>
    </message>
    <message>
        <source>Bone over %1, mm</source>
        <translation>Knochen über %1, mm</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ThreeDView</name>
    <message>
        <source>3D view</source>
        <translation>3D-Ansicht</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ToolWarnings</name>
    <message>
        <source>no warnings yet: structures are being measured</source>
        <translation>noch keine Warnungen: Die Strukturen werden vermessen</translation>
    </message>
    <message>
        <source>no warnings: the structures cannot be measured</source>
        <translation>keine Warnungen: Die Strukturen lassen sich nicht vermessen</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::TransferPlot</name>
    <message>
        <source>Counting…</source>
        <translation>Wird gezählt…</translation>
    </message>
    <message>
        <source>Drag a point: intensity and opacity of 1 mm; Shift: one of them.
Double click: a new point.  Del: remove.  Arrows: move, Shift: finer.
Ctrl+arrows: another point.  Page up, down: another structure.
Wheel, + and -: zoom.  Middle drag: move.  0: the whole axis.</source>
        <translation>Einen Punkt ziehen: Intensität und Deckkraft von 1 mm; Umschalt: eines davon.
Doppelklick: neuer Punkt.  Entf: entfernen.  Pfeile: bewegen, Umschalt: feiner.
Strg+Pfeile: anderer Punkt.  Bild auf, ab: andere Struktur.
Rad, + und -: zoomen.  Mitte ziehen: bewegen.  0: ganze Achse.</translation>
    </message>
    <message>
        <source>Bone</source>
        <translation>Knochen</translation>
    </message>
    <message>
        <source>Point %1 of %2: %3, opacity %4 of 1 mm, specular %5</source>
        <translation>Punkt %1 von %2: %3, Deckkraft %4 von 1 mm, Glanzlicht %5</translation>
    </message>
    <message>
        <source>bone</source>
        <translation>Knochen</translation>
    </message>
    <message>
        <source>One colour at every intensity</source>
        <translation>Eine Farbe bei jeder Intensität</translation>
    </message>
    <message>
        <source>%1 points, none is selected</source>
        <translation>%1 Punkte, keiner ist gewählt</translation>
    </message>
    <message>
        <source>Transfer function of %1</source>
        <translation>Transferfunktion von %1</translation>
    </message>
    <message>
        <source>Soft tissue</source>
        <translation>Weichgewebe</translation>
    </message>
    <message>
        <source>soft tissue</source>
        <translation>Weichgewebe</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::VideoController</name>
    <message>
        <source>Vide&amp;o</source>
        <translation>&amp;Video</translation>
    </message>
    <message>
        <source>&amp;Play</source>
        <translation>Ab&amp;spielen</translation>
    </message>
    <message>
        <source>Plays the video, or pauses it</source>
        <translation>Spielt das Video ab oder hält es an</translation>
    </message>
    <message>
        <source>Step &amp;back</source>
        <translation>Ein Bild &amp;zurück</translation>
    </message>
    <message>
        <source>To the frame before</source>
        <translation>Zum Bild davor</translation>
    </message>
    <message>
        <source>Step &amp;forward</source>
        <translation>Ein Bild &amp;weiter</translation>
    </message>
    <message>
        <source>To the frame after</source>
        <translation>Zum Bild danach</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>&amp;Loop</source>
        <translation>Wieder&amp;holen</translation>
    </message>
    <message>
        <source>Repeats the part between the two bookmarks that are chosen in the list</source>
        <translation>Wiederholt den Teil zwischen den beiden Lesezeichen, die in der Liste gewählt sind</translation>
    </message>
    <message>
        <source>Loop</source>
        <translation>Wiederholen</translation>
    </message>
    <message>
        <source>Set a book&amp;mark</source>
        <translation>Lesezei&amp;chen setzen</translation>
    </message>
    <message>
        <source>At the frame that is seen, tied to the last stroke</source>
        <translation>Beim Bild, das zu sehen ist, verbunden mit dem Bohrzug, nach dem der Knochen jetzt ist</translation>
    </message>
    <message>
        <source>Bookmark</source>
        <translation>Lesezeichen</translation>
    </message>
    <message>
        <source>Pre&amp;vious bookmark</source>
        <translation>&amp;Voriges Lesezeichen</translation>
    </message>
    <message>
        <source>With the bone as it was then</source>
        <translation>Mit dem Knochen, wie er damals war</translation>
    </message>
    <message>
        <source>&amp;Next bookmark</source>
        <translation>&amp;Nächstes Lesezeichen</translation>
    </message>
    <message>
        <source>&amp;Add the landmark</source>
        <translation>&amp;Landmarke hinzufügen</translation>
    </message>
    <message>
        <source>The crosshair marks the point of the patient that was clicked in the still</source>
        <translation>Das Fadenkreuz markiert den Punkt des Patienten, der im Standbild angeklickt wurde</translation>
    </message>
    <message>
        <source>Add landmark</source>
        <translation>Landmarke</translation>
    </message>
    <message>
        <source>View from the &amp;still</source>
        <translation>Sicht des Stand&amp;bilds</translation>
    </message>
    <message>
        <source>The 3D view from where the still was taken, with the still over it</source>
        <translation>Die 3D-Ansicht von dort, wo das Standbild aufgenommen wurde, mit ihm darüber</translation>
    </message>
    <message>
        <source>View from it</source>
        <translation>Seine Sicht</translation>
    </message>
    <message>
        <source>No bookmark comes after this frame</source>
        <translation>Nach diesem Bild kommt kein Lesezeichen</translation>
    </message>
    <message>
        <source>No bookmark comes before this frame</source>
        <translation>Vor diesem Bild liegt kein Lesezeichen</translation>
    </message>
    <message>
        <source>Choose a video in the panel Video first</source>
        <translation>Wählen Sie zuerst ein Video im Bereich Video</translation>
    </message>
    <message>
        <source>The video has no bookmarks</source>
        <translation>Das Video hat keine Lesezeichen</translation>
    </message>
    <message>
        <source>The video has no two bookmarks</source>
        <translation>Das Video hat keine zwei Lesezeichen</translation>
    </message>
    <message>
        <source>Click the point in the still first</source>
        <translation>Klicken Sie zuerst den Punkt im Standbild an</translation>
    </message>
    <message>
        <source>The still has too few landmarks</source>
        <translation>Das Standbild hat zu wenige Landmarken</translation>
    </message>
    <message>
        <source>&amp;Pause</source>
        <translation>An&amp;halten</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>“%1” is set, tied to stroke %2</source>
        <translation>„%1“ ist gesetzt, verbunden mit Bohrzug %2</translation>
    </message>
    <message>
        <source>“%1” is set, tied to no stroke: nothing is drilled, or it is not saved yet</source>
        <translation>„%1“ ist gesetzt, mit keinem Bohrzug verbunden: Es ist nichts gebohrt oder noch nicht gespeichert</translation>
    </message>
    <message>
        <source>A video may show or name the patient. It stays here when the case is archived or sent, unless asked.</source>
        <translation>Ein Video kann den Patienten zeigen oder nennen. Es bleibt hier, wenn der Fall archiviert oder gesendet wird, außer auf Wunsch.</translation>
    </message>
    <message>
        <source>The file is damaged after %1; it goes on at %2</source>
        <translation>Die Datei ist nach %1 beschädigt; es geht bei %2 weiter</translation>
    </message>
    <message>
        <source>The file is damaged or not whole: its last picture is at %1</source>
        <translation>Die Datei ist beschädigt oder nicht vollständig: Ihr letztes Bild ist bei %1</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::VideoPanel</name>
    <message>
        <source>The attached video that is shown</source>
        <translation>Das angehängte Video, das gezeigt wird</translation>
    </message>
    <message>
        <source>&amp;Over the 3D view</source>
        <translation>&amp;Über der 3D-Ansicht</translation>
    </message>
    <message>
        <source>Opacity of the still over the 3D view</source>
        <translation>Deckkraft des Standbilds über der 3D-Ansicht</translation>
    </message>
    <message>
        <source>&amp;Attach…</source>
        <translation>An&amp;hängen…</translation>
    </message>
    <message>
        <source>A video goes with the case, copied or linked (Case &gt; Attach…)</source>
        <translation>Ein Video gehört zum Fall, kopiert oder verknüpft (Fall &gt; Anlage anhängen…)</translation>
    </message>
    <message>
        <source>Place in the video</source>
        <translation>Stelle im Video</translation>
    </message>
    <message>
        <source>Bookmarks</source>
        <translation>Lesezeichen</translation>
    </message>
    <message>
        <source>Bookmark</source>
        <translation>Lesezeichen</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>After stroke</source>
        <translation>Nach Bohrzug</translation>
    </message>
    <message>
        <source>Return or a double click goes there; where a bookmark is tied to a stroke, the dissection is shown as it is after it</source>
        <translation>Eingabe oder Doppelklick geht dorthin; ist ein Lesezeichen mit einem Bohrzug verbunden, wird der Knochen gezeigt, wie er danach ist</translation>
    </message>
    <message>
        <source>&amp;Move here</source>
        <translation>&amp;Hierher</translation>
    </message>
    <message>
        <source>To the frame that is seen</source>
        <translation>Zum Bild, das zu sehen ist</translation>
    </message>
    <message>
        <source>&amp;Tie</source>
        <translation>&amp;Verbinden</translation>
    </message>
    <message>
        <source>To the last stroke, or from any stroke</source>
        <translation>Mit dem Bohrzug, nach dem der Knochen jetzt ist, oder mit keinem</translation>
    </message>
    <message>
        <source>&amp;Remove</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>Takes the bookmark out</source>
        <translation>Nimmt das Lesezeichen heraus</translation>
    </message>
    <message>
        <source>Landmarks of the still</source>
        <translation>Landmarken des Standbilds</translation>
    </message>
    <message>
        <source>Patient, mm</source>
        <translation>Patient, mm</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>Restfehler</translation>
    </message>
    <message>
        <source>Re&amp;move</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>The landmark that is chosen</source>
        <translation>Die gewählte Landmarke</translation>
    </message>
    <message>
        <source>Remove all</source>
        <translation>Alle entfernen</translation>
    </message>
    <message>
        <source>All landmarks of this still</source>
        <translation>Alle Landmarken dieses Standbilds</translation>
    </message>
    <message>
        <source>Vertical angle of view, if it is known: then four landmarks are enough</source>
        <translation>Senkrechter Bildwinkel, wenn er bekannt ist: dann genügen vier Landmarken</translation>
    </message>
    <message>
        <source>°</source>
        <translation>°</translation>
    </message>
    <message>
        <source>to be found</source>
        <translation>wird gesucht</translation>
    </message>
    <message>
        <source>The still lies over the 3D view while that is the still&apos;s own view</source>
        <translation>Das Standbild liegt über der 3D-Ansicht, solange sie dessen eigene Sicht ist</translation>
    </message>
    <message>
        <source>Where the still was taken from</source>
        <translation>Von wo das Standbild aufgenommen wurde</translation>
    </message>
    <message>
        <source>An&amp;gle of view</source>
        <translation>Bild&amp;winkel</translation>
    </message>
    <message>
        <source>No video is attached</source>
        <translation>Kein Video ist angehängt</translation>
    </message>
    <message>
        <source>No video</source>
        <translation>Kein Video</translation>
    </message>
    <message>
        <source>Video support was not built: this program was built without GStreamer.</source>
        <translation>Videos werden nicht unterstützt: Dieses Programm wurde ohne GStreamer gebaut.</translation>
    </message>
    <message>
        <source>Attach a video of the operation, copied or as a link.</source>
        <translation>Hängen Sie ein Video der Operation an, kopiert oder verknüpft.</translation>
    </message>
    <message>
        <source>Choose a video above.</source>
        <translation>Wählen Sie oben ein Video.</translation>
    </message>
    <message>
        <source>gone</source>
        <translation>fehlt</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>%1, does not fit</source>
        <translation>%1, passt nicht</translation>
    </message>
    <message>
        <source>Now the same point of the patient: click it in the 3D view or a slice, then Add the landmark (Ctrl+U).</source>
        <translation>Nun derselbe Punkt des Patienten: Klicken Sie ihn in der 3D-Ansicht oder einer Schicht an, dann Landmarke hinzufügen (Strg+U).</translation>
    </message>
    <message>
        <source>The camera is being sought…</source>
        <translation>Die Kamera wird gesucht…</translation>
    </message>
    <message>
        <source>Click a point in the still, then the same point of the patient. %1 of at least %2 landmarks are set.</source>
        <translation>Klicken Sie einen Punkt im Standbild an, dann denselben Punkt des Patienten. %1 von mindestens %2 Landmarken sind gesetzt.</translation>
    </message>
    <message>
        <source>Residual %1 px, %2 mm at the landmarks (rms). Uncertainty (standard deviation): %3° of direction, %4 mm of the camera&apos;s place.</source>
        <translation>Restfehler %1 px, %2 mm an den Landmarken (RMS). Unsicherheit (Standardabweichung): %3° der Richtung, %4 mm des Orts der Kamera.</translation>
    </message>
    <message>
        <source>Angle of view %1° ± %2°.</source>
        <translation>Bildwinkel %1° ± %2°.</translation>
    </message>
    <message>
        <source>Left out, as it does not fit the others: landmark %1. Set it anew or remove it.</source>
        <translation>Weggelassen, da sie nicht zu den anderen passt: Landmarke %1. Setzen Sie sie neu oder entfernen Sie sie.</translation>
    </message>
    <message>
        <source>The landmarks do not fit each other; which one is wrong more landmarks would tell.</source>
        <translation>Die Landmarken passen nicht zueinander; welche falsch ist, würden weitere Landmarken zeigen.</translation>
    </message>
    <message>
        <source>Another view explains the landmarks nearly as well: add landmarks of other depth, and look whether the still fits.</source>
        <translation>Eine andere Sicht erklärt die Landmarken fast ebenso gut: Setzen Sie Landmarken in anderer Tiefe, und sehen Sie nach, ob das Standbild passt.</translation>
    </message>
    <message>
        <source>The video is being opened…</source>
        <translation>Das Video wird geöffnet…</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::VideoPicture</name>
    <message>
        <source>Video</source>
        <translation>Video</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::ViewStateController</name>
    <message>
        <source>Sa&amp;ved views</source>
        <translation>Gespeic&amp;herte Ansichten</translation>
    </message>
    <message>
        <source>&amp;Keep this view…</source>
        <translation>Diese Ansicht &amp;behalten…</translation>
    </message>
    <message>
        <source>Camera and slices under a name, saved with the case (Ctrl+K)</source>
        <translation>Kamera und Schichten unter einem Namen, mit dem Fall gespeichert (Strg+K)</translation>
    </message>
    <message>
        <source>Camera and slices under a name, saved with the case</source>
        <translation>Kamera und Schichten unter einem Namen, mit dem Fall gespeichert</translation>
    </message>
    <message>
        <source>&amp;Remove</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>View “%1” removed; Ctrl+Z brings it back</source>
        <translation>Ansicht „%1“ entfernt; Strg+Z holt sie zurück</translation>
    </message>
    <message>
        <source>Keep this view</source>
        <translation>Diese Ansicht behalten</translation>
    </message>
    <message>
        <source>Name of the view (camera and slices). One of that name is replaced.</source>
        <translation>Name der Ansicht (Kamera und Schichten). Eine dieses Namens wird ersetzt.</translation>
    </message>
    <message>
        <source>View “%1” replaced; Ctrl+Z brings back the one before</source>
        <translation>Ansicht „%1“ ersetzt; Strg+Z holt die vorige zurück</translation>
    </message>
    <message>
        <source>View “%1” kept; Save (Ctrl+S) writes it</source>
        <translation>Ansicht „%1“ behalten; Speichern (Strg+S) schreibt sie</translation>
    </message>
    <message>
        <source>View “%1”</source>
        <translation>Ansicht „%1“</translation>
    </message>
</context>
<context>
    <name>petrous::workstation::WindowActions</name>
    <message>
        <source>&amp;Lateral</source>
        <translation>&amp;Lateral</translation>
    </message>
    <message>
        <source>From the side of the ear</source>
        <translation>Von der Ohrseite</translation>
    </message>
    <message>
        <source>&amp;Anterior</source>
        <translation>&amp;Anterior</translation>
    </message>
    <message>
        <source>From the face</source>
        <translation>Vom Gesicht</translation>
    </message>
    <message>
        <source>&amp;Posterior</source>
        <translation>&amp;Posterior</translation>
    </message>
    <message>
        <source>From the back of the head</source>
        <translation>Vom Hinterkopf her</translation>
    </message>
    <message>
        <source>&amp;Superior</source>
        <translation>&amp;Superior</translation>
    </message>
    <message>
        <source>From above, the face up</source>
        <translation>Von oben, das Gesicht oben</translation>
    </message>
    <message>
        <source>&amp;Inferior</source>
        <translation>&amp;Inferior</translation>
    </message>
    <message>
        <source>From below, the face up</source>
        <translation>Von unten, das Gesicht oben</translation>
    </message>
    <message>
        <source>L&amp;eft</source>
        <translation>Li&amp;nks</translation>
    </message>
    <message>
        <source>From the patient&apos;s left</source>
        <translation>Von der linken Seite des Patienten</translation>
    </message>
    <message>
        <source>&amp;Right</source>
        <translation>&amp;Rechts</translation>
    </message>
    <message>
        <source>From the patient&apos;s right</source>
        <translation>Von der rechten Seite des Patienten</translation>
    </message>
    <message>
        <source>Surgical position, le&amp;ft ear</source>
        <translation>OP-Lage, lin&amp;kes Ohr</translation>
    </message>
    <message>
        <source>The patient on the back, the head turned to the right, seen from the left ear: the face up, the vertex on the right</source>
        <translation>Der Patient auf dem Rücken, der Kopf nach rechts gedreht, vom linken Ohr gesehen: das Gesicht oben, der Scheitel rechts</translation>
    </message>
    <message>
        <source>Surgical position, rig&amp;ht ear</source>
        <translation>OP-La&amp;ge, rechtes Ohr</translation>
    </message>
    <message>
        <source>The patient on the back, the head turned to the left, seen from the right ear: the face up, the vertex on the left</source>
        <translation>Der Patient auf dem Rücken, der Kopf nach links gedreht, vom rechten Ohr gesehen: das Gesicht oben, der Scheitel links</translation>
    </message>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Datei</translation>
    </message>
    <message>
        <source>Open &amp;DICOM…</source>
        <translation>&amp;DICOM öffnen…</translation>
    </message>
    <message>
        <source>A folder of CT slices: a new case; of MR slices: for the open case</source>
        <translation>Ein Ordner von CT-Schichten: ein neuer Fall; von MR-Schichten: für den offenen Fall</translation>
    </message>
    <message>
        <source>Open &amp;files…</source>
        <translation>Da&amp;teien öffnen…</translation>
    </message>
    <message>
        <source>A CT as NRRD, NIfTI or MetaImage: a new case; MR, label maps and meshes: for the open case</source>
        <translation>Ein CT als NRRD, NIfTI oder MetaImage: ein neuer Fall; MR, Label-Karten und Netze: für den offenen Fall</translation>
    </message>
    <message>
        <source>Open a &amp;region…</source>
        <translation>&amp;Ausschnitt öffnen…</translation>
    </message>
    <message>
        <source>A DICOM folder, of whose CT or MR only a box is read that you draw: the ear of a whole head</source>
        <translation>Ein DICOM-Ordner, von dessen CT oder MR nur ein gezeichneter Quader gelesen wird: das Ohr eines ganzen Kopfs</translation>
    </message>
    <message>
        <source>Open a region of a f&amp;ile…</source>
        <translation>Ausschnitt einer Date&amp;i öffnen…</translation>
    </message>
    <message>
        <source>A CT, cone beam or MR as NRRD, NIfTI or MetaImage, of which only a box is read that you draw</source>
        <translation>Ein CT, DVT oder MR als NRRD, NIfTI oder MetaImage, wovon nur ein gezeichneter Quader gelesen wird</translation>
    </message>
    <message>
        <source>Open &amp;case…</source>
        <translation>&amp;Fall öffnen…</translation>
    </message>
    <message>
        <source>A case of the library</source>
        <translation>Ein Fall der Bibliothek</translation>
    </message>
    <message>
        <source>&amp;Make the sample patient</source>
        <translation>&amp;Musterpatienten erzeugen</translation>
    </message>
    <message>
        <source>An artificial temporal bone</source>
        <translation>Ein künstliches Felsenbein</translation>
    </message>
    <message>
        <source>&amp;Save</source>
        <translation>&amp;Speichern</translation>
    </message>
    <message>
        <source>Save the case in the library</source>
        <translation>Speichert den Fall in der Bibliothek</translation>
    </message>
    <message>
        <source>Save &amp;as…</source>
        <translation>Speichern &amp;unter…</translation>
    </message>
    <message>
        <source>Save as a new case; the one it came from stays as it was saved</source>
        <translation>Speichert als neuen Fall; der ursprüngliche bleibt, wie er gespeichert war</translation>
    </message>
    <message>
        <source>Cl&amp;ose the case</source>
        <translation>Fall s&amp;chließen</translation>
    </message>
    <message>
        <source>Saves the case, and goes back to the first page</source>
        <translation>Speichert den Fall und kehrt zur ersten Seite zurück</translation>
    </message>
    <message>
        <source>Plan repor&amp;t…</source>
        <translation>&amp;Bericht zum Plan…</translation>
    </message>
    <message>
        <source>The plan as PDF or HTML: pictures, distances with uncertainty, strokes, measurements</source>
        <translation>Der Plan als PDF oder HTML: Bilder, Abstände mit Unsicherheit, Bohrzüge, Messungen</translation>
    </message>
    <message>
        <source>&amp;Picture for print…</source>
        <translation>Bild für den D&amp;ruck…</translation>
    </message>
    <message>
        <source>The 3D view as a PNG of any size, with scale bar and side</source>
        <translation>Die 3D-Ansicht als PNG beliebiger Größe, mit Maßstab und Seite</translation>
    </message>
    <message>
        <source>Fi&amp;lm…</source>
        <translation>Fi&amp;lm…</translation>
    </message>
    <message>
        <source>Once around the patient, or a flight along a canal or nerve</source>
        <translation>Einmal um den Patienten oder ein Flug entlang eines Kanals oder Nervs</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>B&amp;eenden</translation>
    </message>
    <message>
        <source>Save and quit</source>
        <translation>Speichern und beenden</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>&amp;Bearbeiten</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Rückgängig</translation>
    </message>
    <message>
        <source>Take back the last change: a stroke, an appearance, a part</source>
        <translation>Nimmt die letzte Änderung zurück: einen Bohrzug, eine Darstellung, einen Teil</translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation>&amp;Wiederholen</translation>
    </message>
    <message>
        <source>Make the change again that was taken back</source>
        <translation>Macht die zurückgenommene Änderung erneut</translation>
    </message>
    <message>
        <source>Undo goes back to the stroke&apos;s &amp;view</source>
        <translation>Rückgängig kehrt zur &amp;Ansicht des Bohrzugs zurück</translation>
    </message>
    <message>
        <source>Turn the patient as they lay when the stroke was drilled</source>
        <translation>Dreht den Patienten so, wie er beim Bohren des Zugs lag</translation>
    </message>
    <message>
        <source>Se&amp;ttings…</source>
        <translation>&amp;Einstellungen…</translation>
    </message>
    <message>
        <source>Theme, size of the letters, library, and how the window behaves</source>
        <translation>Design, Schriftgröße, Bibliothek und wie sich das Fenster verhält</translation>
    </message>
    <message>
        <source>&amp;Case</source>
        <translation>&amp;Fall</translation>
    </message>
    <message>
        <source>Add &amp;MR…</source>
        <translation>&amp;MR hinzufügen…</translation>
    </message>
    <message>
        <source>A DICOM folder with an MR of this patient</source>
        <translation>Ein DICOM-Ordner mit einem MR dieses Patienten</translation>
    </message>
    <message>
        <source>Add MR &amp;file…</source>
        <translation>MR-&amp;Datei hinzufügen…</translation>
    </message>
    <message>
        <source>An MR of this patient as NIfTI, NRRD, MetaImage or multi-frame DICOM</source>
        <translation>Ein MR dieses Patienten als NIfTI, NRRD, MetaImage oder Multi-Frame-DICOM</translation>
    </message>
    <message>
        <source>Add &amp;labels…</source>
        <translation>&amp;Labels hinzufügen…</translation>
    </message>
    <message>
        <source>Structures of this patient: label maps and segmentations</source>
        <translation>Strukturen dieses Patienten: Label-Karten und Segmentierungen</translation>
    </message>
    <message>
        <source>Add f&amp;older of masks…</source>
        <translation>Maskenord&amp;ner hinzufügen…</translation>
    </message>
    <message>
        <source>Structures of this patient, one a file, as TotalSegmentator writes them</source>
        <translation>Strukturen dieses Patienten, je Datei eine, wie TotalSegmentator sie schreibt</translation>
    </message>
    <message>
        <source>Add m&amp;esh…</source>
        <translation>Net&amp;z hinzufügen…</translation>
    </message>
    <message>
        <source>Surfaces of this patient, in mm</source>
        <translation>Oberflächen dieses Patienten, in mm</translation>
    </message>
    <message>
        <source>A&amp;ttach…</source>
        <translation>Anlage anhän&amp;gen…</translation>
    </message>
    <message>
        <source>A file goes with the case: recording of the tool, PNG, PDF or video</source>
        <translation>Eine Datei geht mit dem Fall: Aufzeichnung des Werkzeugs, PNG, PDF oder Video</translation>
    </message>
    <message>
        <source>E&amp;xport…</source>
        <translation>E&amp;xportieren…</translation>
    </message>
    <message>
        <source>Images, structures or surfaces as files for other programs</source>
        <translation>Bilder, Strukturen oder Oberflächen als Dateien für andere Programme</translation>
    </message>
    <message>
        <source>Archi&amp;ve…</source>
        <translation>&amp;Archivieren…</translation>
    </message>
    <message>
        <source>The case in one file, to hand it on: whole, or only the plan</source>
        <translation>Der Fall in einer Datei, zum Weitergeben: ganz oder nur der Plan</translation>
    </message>
    <message>
        <source>&amp;Restore…</source>
        <translation>&amp;Wiederherstellen…</translation>
    </message>
    <message>
        <source>The case of an archive comes to the library and is opened</source>
        <translation>Der Fall eines Archivs kommt in die Bibliothek und wird geöffnet</translation>
    </message>
    <message>
        <source>Put &amp;back</source>
        <translation>Zurü&amp;cklegen</translation>
    </message>
    <message>
        <source>What was taken out of the case last</source>
        <translation>Was zuletzt aus dem Fall genommen wurde</translation>
    </message>
    <message>
        <source>&amp;Approach</source>
        <translation>&amp;Zugang</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ansicht</translation>
    </message>
    <message>
        <source>Roll counterclock&amp;wise</source>
        <translation>Gegen den Uhr&amp;zeigersinn drehen</translation>
    </message>
    <message>
        <source>Turns the 3D picture about its middle, by 5 degrees</source>
        <translation>Dreht das 3D-Bild um seine Mitte, um 5 Grad</translation>
    </message>
    <message>
        <source>Roll cloc&amp;kwise</source>
        <translation>Im &amp;Uhrzeigersinn drehen</translation>
    </message>
    <message>
        <source>&amp;Centre on the crosshair</source>
        <translation>Au&amp;f das Fadenkreuz zentrieren</translation>
    </message>
    <message>
        <source>The 3D view turns and zooms about the crosshair from now on</source>
        <translation>Die 3D-Ansicht dreht und zoomt von nun an um das Fadenkreuz</translation>
    </message>
    <message>
        <source>C&amp;ut away to the crosshair</source>
        <translation>Bis zu&amp;m Fadenkreuz wegschneiden</translation>
    </message>
    <message>
        <source>What lies before the crosshair is not shown, until a tool is taken up</source>
        <translation>Was vor dem Fadenkreuz liegt, wird nicht gezeigt, bis ein Werkzeug aufgenommen wird</translation>
    </message>
    <message>
        <source>Show what was cut &amp;away</source>
        <translation>&amp;Weggeschnittenes zeigen</translation>
    </message>
    <message>
        <source>Also where the case was saved with a part of the picture only</source>
        <translation>Auch wo der Fall mit nur einem Teil des Bildes gespeichert wurde</translation>
    </message>
    <message>
        <source>Temporal bo&amp;ne window</source>
        <translation>Felsenbeinfe&amp;nster</translation>
    </message>
    <message>
        <source>Grey from -800 to 2000 HU</source>
        <translation>Grau von -800 bis 2000 HU</translation>
    </message>
    <message>
        <source>&amp;Fit slices</source>
        <translation>Schich&amp;ten einpassen</translation>
    </message>
    <message>
        <source>Whole slices again</source>
        <translation>Wieder ganze Schichten</translation>
    </message>
    <message>
        <source>&amp;Drill</source>
        <translation>B&amp;ohren</translation>
    </message>
    <message>
        <source>&amp;Smaller burr</source>
        <translation>&amp;Kleinere Fräse</translation>
    </message>
    <message>
        <source>The next smaller one that is sold</source>
        <translation>Die nächstkleinere erhältliche</translation>
    </message>
    <message>
        <source>&amp;Larger burr</source>
        <translation>&amp;Größere Fräse</translation>
    </message>
    <message>
        <source>The next larger one that is sold</source>
        <translation>Die nächstgrößere erhältliche</translation>
    </message>
    <message>
        <source>Depth &amp;by wheel</source>
        <translation>&amp;Tiefe mit dem Rad</translation>
    </message>
    <message>
        <source>By wheel</source>
        <translation>Mit dem Rad</translation>
    </message>
    <message>
        <source>Slices &amp;follow the burr</source>
        <translation>Schichten &amp;folgen der Fräse</translation>
    </message>
    <message>
        <source>&amp;Record session…</source>
        <translation>Sitzung auf&amp;zeichnen…</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>&amp;Hilfe</translation>
    </message>
    <message>
        <source>&amp;Keys</source>
        <translation>&amp;Tasten</translation>
    </message>
    <message>
        <source>All keys of the window, with a search</source>
        <translation>Alle Tasten des Fensters, mit Suche</translation>
    </message>
    <message>
        <source>&amp;Manual</source>
        <translation>&amp;Handbuch</translation>
    </message>
    <message>
        <source>Opens the manual in the browser: a tutorial, and a chapter for each panel</source>
        <translation>Öffnet das Handbuch im Browser: eine Einführung und ein Kapitel zu jedem Bereich</translation>
    </message>
    <message>
        <source>&amp;Find a command…</source>
        <translation>&amp;Befehl suchen…</translation>
    </message>
    <message>
        <source>Anything that the menus have, by its name</source>
        <translation>Alles, was die Menüs haben, nach Namen</translation>
    </message>
    <message>
        <source>&amp;About Petrous</source>
        <translation>Über &amp;Petrous</translation>
    </message>
    <message>
        <source>What this program is</source>
        <translation>Was dieses Programm ist</translation>
    </message>
    <message>
        <source>Case</source>
        <translation>Fall</translation>
    </message>
    <message>
        <source>Open…</source>
        <translation>Öffnen…</translation>
    </message>
    <message>
        <source>Cases…</source>
        <translation>Fälle…</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Wiederholen</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>Standard sides (1 to 7), surgical position (8 left, 9 right), saved views, layout, stereo, the surgeon&apos;s window (F11)</source>
        <translation>Standardseiten (1 bis 7), Operationslage (8 links, 9 rechts), gespeicherte Ansichten, Anordnung, Stereo, das Fenster des Chirurgen (F11)</translation>
    </message>
    <message>
        <source>&amp;Side</source>
        <translation>&amp;Seite</translation>
    </message>
    <message>
        <source>The side of the patient that is operated on; it stands over every view</source>
        <translation>Die operierte Seite des Patienten; sie steht über jeder Ansicht</translation>
    </message>
    <message>
        <source>Side: &amp;left</source>
        <translation>Seite: &amp;links</translation>
    </message>
    <message>
        <source>Side: &amp;right</source>
        <translation>Seite: &amp;rechts</translation>
    </message>
    <message>
        <source>Side: &amp;both</source>
        <translation>Seite: &amp;beide</translation>
    </message>
    <message>
        <source>Side: &amp;not stated</source>
        <translation>Seite: &amp;nicht angegeben</translation>
    </message>
    <message>
        <source>It is asked for when the case is opened</source>
        <translation>Danach wird beim Öffnen des Falls gefragt</translation>
    </message>
    <message>
        <source>La&amp;yout</source>
        <translation>An&amp;ordnung</translation>
    </message>
    <message>
        <source>3D view, slices &amp;beside</source>
        <translation>3D-Ansicht, Schichten &amp;daneben</translation>
    </message>
    <message>
        <source>The three slices in a column</source>
        <translation>Die drei Schichten in einer Spalte</translation>
    </message>
    <message>
        <source>&amp;Four up</source>
        <translation>&amp;Vier Ansichten</translation>
    </message>
    <message>
        <source>3D view and slices in two rows</source>
        <translation>3D-Ansicht und Schichten in zwei Reihen</translation>
    </message>
    <message>
        <source>&amp;3D view alone</source>
        <translation>Nur &amp;3D-Ansicht</translation>
    </message>
    <message>
        <source>Without slices</source>
        <translation>Ohne Schichten</translation>
    </message>
    <message>
        <source>&amp;One slice large</source>
        <translation>&amp;Eine Schicht groß</translation>
    </message>
    <message>
        <source>The slice that was clicked last; the other views in a column beside it</source>
        <translation>Die zuletzt angeklickte Schicht; die anderen Ansichten in einer Spalte daneben</translation>
    </message>
    <message>
        <source>&amp;Slices alone</source>
        <translation>Nur &amp;Schichten</translation>
    </message>
    <message>
        <source>Side by side, without the 3D view</source>
        <translation>Nebeneinander, ohne die 3D-Ansicht</translation>
    </message>
    <message>
        <source>&amp;Enlarge the view</source>
        <translation>Ansicht ver&amp;größern</translation>
    </message>
    <message>
        <source>Stere&amp;o</source>
        <translation>St&amp;ereo</translation>
    </message>
    <message>
        <source>&amp;Off</source>
        <translation>&amp;Aus</translation>
    </message>
    <message>
        <source>One picture</source>
        <translation>Ein Bild</translation>
    </message>
    <message>
        <source>&amp;Side by side</source>
        <translation>&amp;Nebeneinander</translation>
    </message>
    <message>
        <source>The left eye&apos;s picture on the left half, for head-mounted displays and 3D screens</source>
        <translation>Das Bild des linken Auges auf der linken Hälfte, für Videobrillen und 3D-Bildschirme</translation>
    </message>
    <message>
        <source>&amp;Line-interleaved</source>
        <translation>&amp;Zeilenweise</translation>
    </message>
    <message>
        <source>Rows by turns, for screens with polarised glasses</source>
        <translation>Zeilen im Wechsel, für Bildschirme mit Polarisationsbrille</translation>
    </message>
    <message>
        <source>&amp;Anaglyph</source>
        <translation>Ana&amp;glyph</translation>
    </message>
    <message>
        <source>For red-cyan glasses</source>
        <translation>Für Rot-Cyan-Brillen</translation>
    </message>
    <message>
        <source>&amp;Quad buffer</source>
        <translation>&amp;Quad-Buffer</translation>
    </message>
    <message>
        <source>For shutter glasses, in the surgeon&apos;s window</source>
        <translation>Für Shutterbrillen, im Fenster des Chirurgen</translation>
    </message>
    <message>
        <source>Sur&amp;geon&apos;s window</source>
        <translation>Fenster des &amp;Chirurgen</translation>
    </message>
    <message>
        <source>The scene on a whole screen, the second one where there is one; Esc closes it</source>
        <translation>Die Szene auf einem ganzen Bildschirm, dem zweiten, wo es einen gibt; Esc schließt es</translation>
    </message>
    <message>
        <source>Tissue &amp;thickness over the structure</source>
        <translation>Gewebe&amp;dicke über der Struktur</translation>
    </message>
    <message>
        <source>Bone &amp;thickness over the structure</source>
        <translation>Knochen&amp;dicke über der Struktur</translation>
    </message>
    <message>
        <source>Colours tissue by how much of it is left over the structure that is chosen in the list</source>
        <translation>Färbt Gewebe danach, wie viel davon über der in der Liste gewählten Struktur übrig ist</translation>
    </message>
    <message>
        <source>Colours bone by how much of it is left over the structure that is chosen in the list</source>
        <translation>Färbt Knochen danach, wie viel davon über der in der Liste gewählten Struktur übrig ist</translation>
    </message>
    <message>
        <source>&amp;Full window</source>
        <translation>Ge&amp;samtes Fenster</translation>
    </message>
    <message>
        <source>&amp;Bone window</source>
        <translation>&amp;Knochenfenster</translation>
    </message>
    <message>
        <source>Grey over all tissue of the MR</source>
        <translation>Grau über das ganze Gewebe des MR</translation>
    </message>
    <message>
        <source>Grey from -1300 to 2700 HU</source>
        <translation>Grau von -1300 bis 2700 HU</translation>
    </message>
    <message>
        <source>&amp;Dark half window</source>
        <translation>Fenster der dunklen Hä&amp;lfte</translation>
    </message>
    <message>
        <source>Soft &amp;tissue window</source>
        <translation>Weich&amp;teilfenster</translation>
    </message>
    <message>
        <source>Grey over the darker half of the MR&apos;s tissue</source>
        <translation>Grau über die dunklere Hälfte des Gewebes im MR</translation>
    </message>
    <message>
        <source>Grey from -160 to 240 HU</source>
        <translation>Grau von -160 bis 240 HU</translation>
    </message>
    <message>
        <source>Open a case first</source>
        <translation>Öffnen Sie zuerst einen Fall</translation>
    </message>
    <message>
        <source>Sta&amp;ndard views</source>
        <translation>Sta&amp;ndardansichten</translation>
    </message>
    <message>
        <source>Grey &amp;window of the slices</source>
        <translation>&amp;Graufenster der Schichten</translation>
    </message>
    <message>
        <source>&amp;Panels</source>
        <translation>&amp;Bereiche</translation>
    </message>
    <message>
        <source>Handp&amp;iece</source>
        <translation>Handst&amp;ück</translation>
    </message>
    <message>
        <source>Turn counterclock&amp;wise</source>
        <translation>&amp;Gegen den Uhrzeigersinn drehen</translation>
    </message>
    <message>
        <source>About the line of sight, by 5 degrees; Alt with the wheel does so, too</source>
        <translation>Um die Blickrichtung, um 5 Grad; auch Alt mit dem Rad</translation>
    </message>
    <message>
        <source>Turn clockwi&amp;se</source>
        <translation>&amp;Im Uhrzeigersinn drehen</translation>
    </message>
    <message>
        <source>Tilt &amp;away from the line of sight</source>
        <translation>Von der Blickrichtung &amp;weg neigen</translation>
    </message>
    <message>
        <source>By 5 degrees; Alt and Shift with the wheel do so, too</source>
        <translation>Um 5 Grad; auch Alt und Umschalt mit dem Rad</translation>
    </message>
    <message>
        <source>Tilt to the &amp;line of sight</source>
        <translation>&amp;Zur Blickrichtung neigen</translation>
    </message>
    <message>
        <source>As at &amp;first</source>
        <translation>Wie am &amp;Anfang</translation>
    </message>
    <message>
        <source>The usual turn and tilt of the hand</source>
        <translation>Die übliche Drehung und Neigung der Hand</translation>
    </message>
    <message>
        <source>In the left &amp;hand</source>
        <translation>In der &amp;linken Hand</translation>
    </message>
    <message>
        <source>The handpiece comes from the left of the screen</source>
        <translation>Das Handstück kommt von links ins Bild</translation>
    </message>
    <message>
        <source>Only the &amp;burr is felt</source>
        <translation>Nur die &amp;Fräse wird gefühlt</translation>
    </message>
    <message>
        <source>Three degrees of freedom: shaft and handpiece pass through tissue, and there is no torque</source>
        <translation>Drei Freiheitsgrade: Schaft und Handstück gehen durch Gewebe, und es gibt kein Drehmoment</translation>
    </message>
    <message>
        <source>&amp;Materials and burrs…</source>
        <translation>&amp;Materialien und Fräsen…</translation>
    </message>
    <message>
        <source>The numbers of the removal laws, with their units and sources, and the diameters that the bar offers</source>
        <translation>Die Zahlen der Abtragsgesetze mit ihren Einheiten und Quellen, und die Durchmesser, die die Leiste anbietet</translation>
    </message>
    <message>
        <source>Writes all that tool and drill do to a file, until it is chosen again; the panel Replay and the command line can repeat it</source>
        <translation>Schreibt alles, was Werkzeug und Bohrer tun, in eine Datei, bis es erneut gewählt wird; der Bereich Wiedergabe und die Befehlszeile können es wiederholen</translation>
    </message>
    <message>
        <source>Op&amp;en a recording…</source>
        <translation>Aufzeichnung &amp;öffnen…</translation>
    </message>
    <message>
        <source>A recorded session is played beside the tool in use, with what it took: time, path, force, distances, volumes</source>
        <translation>Eine aufgezeichnete Sitzung wird neben dem eigenen Werkzeug abgespielt, mit Zeit, Weg, Kraft, Abständen und Volumen</translation>
    </message>
    <message>
        <source>Pla&amp;y the recording</source>
        <translation>Aufzeichnung abs&amp;pielen</translation>
    </message>
    <message>
        <source>Plays the recorded tool as a ghost, or pauses it</source>
        <translation>Spielt das aufgezeichnete Werkzeug als Geist ab, oder hält es an</translation>
    </message>
    <message>
        <source>S&amp;ound of the drill</source>
        <translation>T&amp;on des Bohrers</translation>
    </message>
    <message>
        <source>Spindle and teeth, louder in bone and brighter where the wall is thin; a tone while a warning is shown</source>
        <translation>Spindel und Schneiden, lauter im Knochen und heller, wo die Wand dünn ist; ein Signalton, solange vor einer Struktur gewarnt wird</translation>
    </message>
    <message>
        <source>Instr&amp;ument from a file…</source>
        <translation>Instr&amp;ument aus einer Datei…</translation>
    </message>
    <message>
        <source>A closed surface (OBJ, STL, PLY, VTP) of 1 to 300 mm, its tip at the origin: it is felt and drawn, and removes nothing</source>
        <translation>Eine geschlossene Oberfläche (OBJ, STL, PLY, VTP) von 1 bis 300 mm, die Spitze im Ursprung: Sie wird gefühlt und gezeichnet und trägt nichts ab</translation>
    </message>
    <message>
        <source>Cutting, diamond, or the next one of your own</source>
        <translation>Schneidend, Diamant oder die nächste eigene</translation>
    </message>
    <message>
        <source>Next &amp;kind of burr</source>
        <translation>Nächste F&amp;räsenart</translation>
    </message>
    <message>
        <source>The crosshair goes along while the drill is on, and with the tip of the pointer or the instrument</source>
        <translation>Das Fadenkreuz geht mit, während gebohrt wird, und mit der Spitze von Zeiger oder Instrument</translation>
    </message>
    <message>
        <source>T&amp;ake the instrument out of the case</source>
        <translation>Instrument aus &amp;dem Fall nehmen</translation>
    </message>
    <message>
        <source>The next save keeps none with the case; its file stays as it is</source>
        <translation>Das nächste Speichern behält keines mit dem Fall; seine Datei bleibt, wie sie ist</translation>
    </message>
    <message>
        <source>The view that was clicked last fills the window, and goes back; as a double click on it. Esc goes back, too</source>
        <translation>Die zuletzt angeklickte Ansicht füllt das Fenster und kehrt zurück; wie ein Doppelklick auf sie. Auch Esc kehrt zurück</translation>
    </message>
    <message>
        <source>Cut &amp;deeper</source>
        <translation>T&amp;iefer wegschneiden</translation>
    </message>
    <message>
        <source>Moves the plane that cuts the picture by 0.5 mm</source>
        <translation>Verschiebt die Ebene, die das Bild schneidet, um 0,5 mm</translation>
    </message>
    <message>
        <source>Cut l&amp;ess deep</source>
        <translation>Wenige&amp;r tief wegschneiden</translation>
    </message>
    <message>
        <source>Moves the plane that cuts the picture back by 0.5 mm</source>
        <translation>Verschiebt die Ebene, die das Bild schneidet, um 0,5 mm zurück</translation>
    </message>
    <message>
        <source>Crop bo&amp;x</source>
        <translation>Beschnitt&amp;quader</translation>
    </message>
    <message>
        <source>Crop &amp;box in numbers…</source>
        <translation>Beschnittquader in &amp;Zahlen…</translation>
    </message>
    <message>
        <source>Where the crop box begins and ends, in mm</source>
        <translation>Wo der Beschnittquader beginnt und endet, in mm</translation>
    </message>
    <message>
        <source>A box whose edges are dragged in the slices, and its faces in the 3D view: only what is in it is shown, until a tool is taken up. Its middle in the 3D view, or a drag with Shift, moves all of it. A double click on an edge shows all of the image</source>
        <translation>Ein Quader, dessen Kanten in den Schichten und dessen Flächen in der 3D-Ansicht gezogen werden: Nur was darin liegt, wird gezeigt, bis ein Werkzeug aufgenommen wird. Seine Mitte in der 3D-Ansicht oder Ziehen mit der Umschalttaste verschiebt ihn ganz. Ein Doppelklick auf eine Kante zeigt das ganze Bild</translation>
    </message>
    <message>
        <source>Handpiece: &amp;transmastoid</source>
        <translation>Handstück: &amp;transmastoidal</translation>
    </message>
    <message>
        <source>As held for a mastoidectomy: onto the mastoid from the side, the surgeon behind the ear. It follows the view from there</source>
        <translation>Wie für eine Mastoidektomie gehalten: von der Seite auf das Mastoid, der Operateur hinter dem Ohr. Von da an folgt es der Ansicht</translation>
    </message>
    <message>
        <source>Handpiece: &amp;posterior tympanotomy</source>
        <translation>Handstück: &amp;posteriore Tympanotomie</translation>
    </message>
    <message>
        <source>As held for the facial recess: 30° from behind, past the posterior wall of the canal. It follows the view from there</source>
        <translation>Wie für den Recessus facialis gehalten: 30° von hinten, an der hinteren Gehörgangswand vorbei. Von da an folgt es der Ansicht</translation>
    </message>
    <message>
        <source>Handpiece: trans&amp;labyrinthine</source>
        <translation>Handstück: trans&amp;labyrinthär</translation>
    </message>
    <message>
        <source>As held for the labyrinth: 15° from behind, along the internal auditory canal. It follows the view from there</source>
        <translation>Wie für das Labyrinth gehalten: 15° von hinten, entlang dem inneren Gehörgang. Von da an folgt es der Ansicht</translation>
    </message>
    <message>
        <source>Handpiece: &amp;retrosigmoid</source>
        <translation>Handstück: &amp;retrosigmoidal</translation>
    </message>
    <message>
        <source>As held behind the sinus: 45° from behind, along the posterior face of the petrous pyramid. It follows the view from there</source>
        <translation>Wie hinter dem Sinus gehalten: 45° von hinten, entlang der Hinterfläche der Felsenbeinpyramide. Von da an folgt es der Ansicht</translation>
    </message>
    <message>
        <source>Handpiece: &amp;middle fossa</source>
        <translation>Handstück: &amp;mittlere Schädelgrube</translation>
    </message>
    <message>
        <source>As held above the ear: 45° from above, the surgeon at the vertex. It follows the view from there</source>
        <translation>Wie oberhalb des Ohrs gehalten: 45° von oben, der Operateur am Scheitel. Von da an folgt es der Ansicht</translation>
    </message>
    <message>
        <source>F&amp;or an approach</source>
        <translation>Fü&amp;r einen Zugang</translation>
    </message>
    <message>
        <source>&amp;Correct the axes…</source>
        <translation>Achsen &amp;korrigieren…</translation>
    </message>
    <message>
        <source>Of an image that is mirrored or lies otherwise than its letters say: a new case of it with the right ones</source>
        <translation>Bei einem Bild, das gespiegelt ist oder anders liegt, als seine Buchstaben sagen: ein neuer Fall daraus mit den richtigen</translation>
    </message>
    <message>
        <source>By a degree, within the slice that has the keyboard; in the 3D view about the vertical of the picture, as seen from above</source>
        <translation>Um ein Grad, in der Schicht, der die Tastatur gehört; in der 3D-Ansicht um die Senkrechte des Bildes, von oben gesehen</translation>
    </message>
    <message>
        <source>Clipping plan&amp;e</source>
        <translation>Schn&amp;ittebene</translation>
    </message>
    <message>
        <source>Turn the cut &amp;counterclockwise</source>
        <translation>Schnitt &amp;gegen den Uhrzeigersinn drehen</translation>
    </message>
    <message>
        <source>&amp;Turn the cut clockwise</source>
        <translation>Schnitt im &amp;Uhrzeigersinn drehen</translation>
    </message>
</context>
</TS>
