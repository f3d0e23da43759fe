<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en_GB">
<context>
    <name></name>
    <message>
        <source>Palm. abd.</source>
        <translation>Palm.-Abd.</translation>
    </message>
    <message>
        <source>DIP (thumb: IP)</source>
        <translation>DIP (Daumen: IP)</translation>
    </message>
    <message>
        <source>Close Carpus</source>
        <translation>Carpus schließen</translation>
    </message>
    <message>
        <source>Choose another folder</source>
        <translation>Anderen Ordner wählen</translation>
    </message>
    <message>
        <source>Folder of patients and sessions</source>
        <translation>Ordner der Patienten und Sitzungen</translation>
    </message>
    <message>
        <source>Flexion–extension</source>
        <translation>Flexion–Extension</translation>
    </message>
    <message>
        <source>Radial–ulnar deviation</source>
        <translation>Radial-/Ulnarduktion</translation>
    </message>
    <message>
        <source>Thumb MCP, abduction–adduction</source>
        <translation>Daumen MCP, Ab-/Adduktion</translation>
    </message>
    <message>
        <source>flexion</source>
        <translation>Flexion</translation>
    </message>
    <message>
        <source>extension</source>
        <translation>Extension</translation>
    </message>
    <message>
        <source>radial</source>
        <translation>radial</translation>
    </message>
    <message>
        <source>ulnar</source>
        <translation>ulnar</translation>
    </message>
    <message>
        <source>supination</source>
        <translation>Supination</translation>
    </message>
    <message>
        <source>pronation</source>
        <translation>Pronation</translation>
    </message>
    <message>
        <source>more</source>
        <translation>mehr</translation>
    </message>
    <message>
        <source>less</source>
        <translation>weniger</translation>
    </message>
    <message>
        <source>{low} to {high}</source>
        <translation>{low} bis {high}</translation>
    </message>
    <message>
        <source>{first} and {last}</source>
        <translation>{first} und {last}</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>Grip</source>
        <translation>Griffkraft</translation>
    </message>
    <message>
        <source>Key pinch</source>
        <translation>Schlüsselgriff</translation>
    </message>
    <message>
        <source>Three-point pinch</source>
        <translation>Dreipunktgriff</translation>
    </message>
    <message>
        <source>Tip pinch</source>
        <translation>Spitzgriff</translation>
    </message>
    <message>
        <source>Wrist circumference</source>
        <translation>Umfangsmaß Handgelenk</translation>
    </message>
    <message>
        <source>Palm circumference (MCP level)</source>
        <translation>Umfangsmaß Mittelhand (MCP)</translation>
    </message>
    <message>
        <source>Figure-of-eight (hand oedema)</source>
        <translation>Achtertour-Messung (Handödem)</translation>
    </message>
    <message>
        <source>Volume of the hand</source>
        <translation>Handvolumen</translation>
    </message>
    <message>
        <source>Pain at rest</source>
        <translation>Schmerz in Ruhe</translation>
    </message>
    <message>
        <source>Pain on movement</source>
        <translation>Bewegungsschmerz</translation>
    </message>
    <message>
        <source>MCP</source>
        <translation>MCP</translation>
    </message>
    <message>
        <source>PIP</source>
        <translation>PIP</translation>
    </message>
    <message>
        <source>DIP</source>
        <translation>DIP</translation>
    </message>
    <message>
        <source>Thumb</source>
        <translation>Daumen</translation>
    </message>
    <message>
        <source>{finger} finger</source>
        <translation>{finger}</translation>
    </message>
    <message>
        <source>Wrist, {movement}</source>
        <translation>Handgelenk, {movement}</translation>
    </message>
    <message>
        <source>{finger}, {joint}, {movement}</source>
        <translation>{finger}, {joint}, {movement}</translation>
    </message>
    <message>
        <source>active</source>
        <translation>aktiv</translation>
    </message>
    <message>
        <source>passive</source>
        <translation>passiv</translation>
    </message>
    <message>
        <source>of {most}</source>
        <translation>von {most}</translation>
    </message>
    <message>
        <source>Goniometer</source>
        <translation>Goniometer</translation>
    </message>
    <message>
        <source>Force</source>
        <translation>Kraft</translation>
    </message>
    <message>
        <source>Circumference and volume</source>
        <translation>Umfangsmaße und Volumen</translation>
    </message>
    <message>
        <source>Scores</source>
        <translation>Punktwerte</translation>
    </message>
    <message>
        <source>lower is better</source>
        <translation>niedriger ist besser</translation>
    </message>
    <message>
        <source>higher is better</source>
        <translation>höher ist besser</translation>
    </message>
    <message>
        <source>{side}, {day}</source>
        <translation>{side}, {day}</translation>
    </message>
    <message>
        <source>{name}, affected</source>
        <translation>{name}, betroffen</translation>
    </message>
    <message>
        <source>{name} · mirrored</source>
        <translation>{name} · gespiegelt</translation>
    </message>
    <message>
        <source>{name}, unaffected</source>
        <translation>{name}, nicht betroffen</translation>
    </message>
    <message>
        <source>Not compared: the two sessions share no movement.</source>
        <translation>Nicht verglichen: Die beiden Sitzungen haben keine gemeinsame Bewegung.</translation>
    </message>
    <message>
        <source>Not compared: {why}.</source>
        <translation>Nicht verglichen: {why}.</translation>
    </message>
    <message>
        <source>No difference beyond measurement error between right and left.</source>
        <translation>Rechts und links unterscheiden sich nicht um mehr als den Messfehler.</translation>
    </message>
    <message>
        <source>{movement}: {size} less on the right than on the left.</source>
        <translation>{movement}: rechts {size} weniger als links.</translation>
    </message>
    <message>
        <source>{movement}: {size} more on the right than on the left.</source>
        <translation>{movement}: rechts {size} mehr als links.</translation>
    </message>
    <message>
        <source>{movement}: {size} less on the left than on the right.</source>
        <translation>{movement}: links {size} weniger als rechts.</translation>
    </message>
    <message>
        <source>{movement}: {size} more on the left than on the right.</source>
        <translation>{movement}: links {size} mehr als rechts.</translation>
    </message>
    <message>
        <source>Not comparable: {why}. Values are shown without an assessment.</source>
        <translation>Nicht vergleichbar: {why}. Die Werte werden ohne Beurteilung gezeigt.</translation>
    </message>
    <message>
        <source>partly occluded</source>
        <translation>teilweise verdeckt</translation>
    </message>
    <message>
        <source>not compared: {why}</source>
        <translation>nicht verglichen: {why}</translation>
    </message>
    <message>
        <source>The other hand is a comparison, not a norm: left and right differ in healthy people too.</source>
        <translation>Die andere Hand ist ein Vergleich, keine Norm: Links und rechts unterscheiden sich auch bei Gesunden.</translation>
    </message>
    <message>
        <source>{name}: {what}</source>
        <translation>{name}: {what}</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>Unterschied</translation>
    </message>
    <message>
        <source>not assessed</source>
        <translation>nicht beurteilt</translation>
    </message>
    <message>
        <source>improved</source>
        <translation>verbessert</translation>
    </message>
    <message>
        <source>worse</source>
        <translation>verschlechtert</translation>
    </message>
    <message>
        <source>{before} → {after} since {day}</source>
        <translation>{before} → {after} seit dem {day}</translation>
    </message>
    <message>
        <source>(MDC {size})</source>
        <translation>(MDC {size})</translation>
    </message>
    <message>
        <source>left edge</source>
        <translation>linke Kante</translation>
    </message>
    <message>
        <source>right edge</source>
        <translation>rechte Kante</translation>
    </message>
    <message>
        <source>upper edge</source>
        <translation>obere Kante</translation>
    </message>
    <message>
        <source>lower edge</source>
        <translation>untere Kante</translation>
    </message>
    <message>
        <source>top left</source>
        <translation>oben links</translation>
    </message>
    <message>
        <source>top right</source>
        <translation>oben rechts</translation>
    </message>
    <message>
        <source>bottom left</source>
        <translation>unten links</translation>
    </message>
    <message>
        <source>bottom right</source>
        <translation>unten rechts</translation>
    </message>
    <message>
        <source>left</source>
        <translation>links</translation>
    </message>
    <message>
        <source>right</source>
        <translation>rechts</translation>
    </message>
    <message>
        <source>top</source>
        <translation>oben</translation>
    </message>
    <message>
        <source>bottom</source>
        <translation>unten</translation>
    </message>
    <message>
        <source>middle</source>
        <translation>Mittelf.</translation>
    </message>
    <message>
        <source>centre</source>
        <translation>Mitte</translation>
    </message>
    <message>
        <source>Move the board to the {place}</source>
        <translation>Tafel ins Feld {place}</translation>
    </message>
    <message>
        <source>Tilt the board: {side} nearer</source>
        <translation>Tafel neigen: {side} näher</translation>
    </message>
    <message>
        <source>Move the board nearer</source>
        <translation>Tafel näher heran</translation>
    </message>
    <message>
        <source>Hold still.</source>
        <translation>Stillhalten.</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>Calculate · show the board</source>
        <translation>Berechnen · Tafel vor die Kamera halten</translation>
    </message>
    <message>
        <source>Calculate · 1 more image</source>
        <translation>Berechnen · noch 1 Bild</translation>
    </message>
    <message>
        <source>Calculate · {count} more images</source>
        <translation>Berechnen · noch {count} Bilder</translation>
    </message>
    <message>
        <source>Calculate</source>
        <translation>Berechnen</translation>
    </message>
    <message>
        <source>Not good enough: reprojection error {error} px.</source>
        <translation>Nicht gut genug: Reprojektionsfehler {error} px.</translation>
    </message>
    <message>
        <source>Depth and colour are misaligned by {apart} px.</source>
        <translation>Tiefe und Farbe sind um {apart} px versetzt.</translation>
    </message>
    <message>
        <source>The reprojection error is {error} pixels.</source>
        <translation>Der Reprojektionsfehler beträgt {error} Pixel.</translation>
    </message>
    <message>
        <source>The camera is calibrated. {depth}</source>
        <translation>Die Kamera ist kalibriert. {depth}</translation>
    </message>
    <message>
        <source>Depth is correct.</source>
        <translation>Die Tiefe stimmt.</translation>
    </message>
    <message>
        <source>Depth was {share} % too large.</source>
        <translation>Die Tiefe war {share} % zu groß.</translation>
    </message>
    <message>
        <source>Depth was {share} % too small.</source>
        <translation>Die Tiefe war {share} % zu klein.</translation>
    </message>
    <message>
        <source>good: below {limit} px</source>
        <translation>gut: unter {limit} px</translation>
    </message>
    <message>
        <source>fair: below {limit} px</source>
        <translation>mäßig: unter {limit} px</translation>
    </message>
    <message>
        <source>poor: above {limit} px</source>
        <translation>schlecht: über {limit} px</translation>
    </message>
    <message>
        <source>Reprojection error</source>
        <translation>Reprojektionsfehler</translation>
    </message>
    <message>
        <source>Focal length</source>
        <translation>Brennweite</translation>
    </message>
    <message>
        <source>corrected</source>
        <translation>korrigiert</translation>
    </message>
    <message>
        <source>Depth</source>
        <translation>Tiefe</translation>
    </message>
    <message>
        <source>Depth scale</source>
        <translation>Maßstab der Tiefe</translation>
    </message>
    <message>
        <source>{apart} px apart</source>
        <translation>Versatz {apart} px</translation>
    </message>
    <message>
        <source>good: below {most} px</source>
        <translation>gut: unter {most} px</translation>
    </message>
    <message>
        <source>Not calibrated and not checked yet.</source>
        <translation>Noch nicht kalibriert und nicht geprüft.</translation>
    </message>
    <message>
        <source>today</source>
        <translation>heute</translation>
    </message>
    <message>
        <source>yesterday</source>
        <translation>gestern</translation>
    </message>
    <message>
        <source>{days} days ago</source>
        <translation>vor {days} Tagen</translation>
    </message>
    <message>
        <source>This camera has not been checked yet.</source>
        <translation>Diese Kamera ist noch nicht geprüft.</translation>
    </message>
    <message>
        <source>{count} of 6 markers visible. Show the whole card in the image, in even light, with its wedge upright.</source>
        <translation>{count} von 6 Markern sichtbar. Zeigen Sie die ganze Karte im Bild, bei gleichmäßigem Licht, mit aufrechtem Keil.</translation>
    </message>
    <message>
        <source>All six markers are visible. Do not move the card.</source>
        <translation>Alle sechs Marker sind sichtbar. Die Karte nicht bewegen.</translation>
    </message>
    <message>
        <source>Palmar abduction</source>
        <translation>Palmarabduktion</translation>
    </message>
    <message>
        <source>TAM</source>
        <translation>TAM</translation>
    </message>
    <message>
        <source>{finger}, {joint}</source>
        <translation>{finger}, {joint}</translation>
    </message>
    <message>
        <source>In the plane of the palm (0°)</source>
        <translation>In der Handebene (0°)</translation>
    </message>
    <message>
        <source>Palmar abduction {angle}</source>
        <translation>Palmarabduktion {angle}</translation>
    </message>
    <message>
        <source>Ulnar {angle}</source>
        <translation>Ulnar {angle}</translation>
    </message>
    <message>
        <source>Radial {angle}</source>
        <translation>Radial {angle}</translation>
    </message>
    <message>
        <source>Adducted {angle}</source>
        <translation>Adduziert {angle}</translation>
    </message>
    <message>
        <source>Abducted {angle}</source>
        <translation>Abduziert {angle}</translation>
    </message>
    <message>
        <source>Measurement error (MDC95)</source>
        <translation>Messfehler (MDC95)</translation>
    </message>
    <message>
        <source>Used in progress and reports instead of the values above.</source>
        <translation>Gilt in Verlauf und Berichten anstelle der Werte oben.</translation>
    </message>
    <message>
        <source>Not used: at least {count} people are needed.</source>
        <translation>Nicht verwendet: Mindestens {count} Personen sind nötig.</translation>
    </message>
    <message>
        <source>{count} people, not used</source>
        <translation>{count} Personen, nicht verwendet</translation>
    </message>
    <message>
        <source>Flexion–extension, total arc</source>
        <translation>Flexion–Extension, Gesamtausmaß</translation>
    </message>
    <message>
        <source>Radial–ulnar deviation, total arc</source>
        <translation>Radial-/Ulnarduktion, Gesamtausmaß</translation>
    </message>
    <message>
        <source>Pronation–supination, total arc</source>
        <translation>Pro-/Supination, Gesamtausmaß</translation>
    </message>
    <message>
        <source>Range of motion of a finger’s MCP, PIP or DIP</source>
        <translation>Bewegungsausmaß von MCP, PIP oder DIP eines Fingers</translation>
    </message>
    <message>
        <source>Range of finger abduction</source>
        <translation>Bewegungsausmaß der Fingerabduktion</translation>
    </message>
    <message>
        <source>Range of motion of the thumb joints</source>
        <translation>Bewegungsausmaß der Daumengelenke</translation>
    </message>
    <message>
        <source>Total active motion (TAM)</source>
        <translation>Aktive Gesamtbeweglichkeit (TAM)</translation>
    </message>
    <message>
        <source>{row}, range of motion</source>
        <translation>{row}, Bewegungsausmaß</translation>
    </message>
    <message>
        <source>Carpus: markers and set-up</source>
        <translation>Carpus: Marker und Aufbau</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>Lock</source>
        <translation>Sperre</translation>
    </message>
    <message>
        <source>Search for a patient</source>
        <translation>Einen Patienten suchen</translation>
    </message>
    <message>
        <source>New patient</source>
        <translation>Neuer Patient</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>Exportieren</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Start recording, or stop and review</source>
        <translation>Aufnahme starten, oder beenden und auswerten</translation>
    </message>
    <message>
        <source>Pedal: continue, record, stop</source>
        <translation>Pedal: weiter, aufnehmen, beenden</translation>
    </message>
    <message>
        <source>Pause or resume</source>
        <translation>Anhalten oder fortsetzen</translation>
    </message>
    <message>
        <source>Accept the proposed marker</source>
        <translation>Vorgeschlagenen Marker annehmen</translation>
    </message>
    <message>
        <source>New image</source>
        <translation>Neues Bild</translation>
    </message>
    <message>
        <source>Enlarge the image of the last session</source>
        <translation>Bild der letzten Sitzung vergrößern</translation>
    </message>
    <message>
        <source>Thumb cannot fully extend</source>
        <translation>Daumen nicht vollständig streckbar</translation>
    </message>
    <message>
        <source>Index finger cannot fully extend</source>
        <translation>Zeigefinger nicht vollständig streckbar</translation>
    </message>
    <message>
        <source>Middle finger cannot fully extend</source>
        <translation>Mittelfinger nicht vollständig streckbar</translation>
    </message>
    <message>
        <source>Ring finger cannot fully extend</source>
        <translation>Ringfinger nicht vollständig streckbar</translation>
    </message>
    <message>
        <source>Little finger cannot fully extend</source>
        <translation>Kleinfinger nicht vollständig streckbar</translation>
    </message>
    <message>
        <source>Play or stop</source>
        <translation>Abspielen oder anhalten</translation>
    </message>
    <message>
        <source>Previous frame</source>
        <translation>Voriges Bild</translation>
    </message>
    <message>
        <source>Next frame</source>
        <translation>Nächstes Bild</translation>
    </message>
    <message>
        <source>Exclude or include a repetition</source>
        <translation>Wiederholung aus- oder einschließen</translation>
    </message>
    <message>
        <source>Open the selected session</source>
        <translation>Ausgewählte Sitzung öffnen</translation>
    </message>
    <message>
        <source>Correct a marker</source>
        <translation>Marker korrigieren</translation>
    </message>
    <message>
        <source>Marker not visible here</source>
        <translation>Marker hier nicht sichtbar</translation>
    </message>
    <message>
        <source>Next uncertain frame</source>
        <translation>Nächstes unsicheres Bild</translation>
    </message>
    <message>
        <source>Draw the angle on the frame</source>
        <translation>Winkel ins Bild zeichnen</translation>
    </message>
    <message>
        <source>Compare the two ticked sessions</source>
        <translation>Die beiden angekreuzten Sitzungen vergleichen</translation>
    </message>
    <message>
        <source>Compare with the other hand or another day</source>
        <translation>Mit der anderen Hand oder einem anderen Tag vergleichen</translation>
    </message>
    <message>
        <source>Ctrl</source>
        <translation>Strg</translation>
    </message>
    <message>
        <source>Alt</source>
        <translation>Alt</translation>
    </message>
    <message>
        <source>Shift</source>
        <translation>Umschalt</translation>
    </message>
    <message>
        <source>Space</source>
        <translation>Leertaste</translation>
    </message>
    <message>
        <source>Backspace</source>
        <translation>Rücktaste</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Tab</source>
        <translation>Tab</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Home exercise sheet</source>
        <translation>Übungsblatt für zu Hause</translation>
    </message>
    <message>
        <source>Pain score</source>
        <translation>Schmerzwert</translation>
    </message>
    <message>
        <source>Next marker</source>
        <translation>Nächster Marker</translation>
    </message>
    <message>
        <source>Previous repetition</source>
        <translation>Vorige Wiederholung</translation>
    </message>
    <message>
        <source>Next repetition</source>
        <translation>Nächste Wiederholung</translation>
    </message>
    <message>
        <source>Uncertain</source>
        <translation>Unsicher</translation>
    </message>
    <message>
        <source>Another blue spot is here</source>
        <translation>Hier ist eine andere blaue Stelle</translation>
    </message>
    <message>
        <source>Is it the {marker}?</source>
        <translation>Ist das „{marker}“?</translation>
    </message>
    <message>
        <source>Which blue spot is the {marker}?</source>
        <translation>Wo ist „{marker}“?</translation>
    </message>
    <message>
        <source>Waiting for the camera image</source>
        <translation>Warten auf das Kamerabild</translation>
    </message>
    <message>
        <source>Hold the hand flat under the camera</source>
        <translation>Hand flach unter die Kamera halten</translation>
    </message>
    <message>
        <source>Too few markers visible</source>
        <translation>Zu wenige Marker sichtbar</translation>
    </message>
    <message>
        <source>Turn the back of the hand to the camera</source>
        <translation>Handrücken zur Kamera drehen</translation>
    </message>
    <message>
        <source>Markers do not match the hand: hold the hand flat for a moment</source>
        <translation>Marker passen nicht zur Hand: Hand kurz flach halten</translation>
    </message>
    <message>
        <source>Hold the hand flat for a moment</source>
        <translation>Die Hand einen Moment flach halten</translation>
    </message>
    <message>
        <source>All {count} markers visible</source>
        <translation>Alle {count} Marker sichtbar</translation>
    </message>
    <message>
        <source>{marker} occluded</source>
        <translation>{marker} verdeckt</translation>
    </message>
    <message>
        <source>Thumb occluded</source>
        <translation>Daumen verdeckt</translation>
    </message>
    <message>
        <source>{finger} finger occluded</source>
        <translation>{finger} verdeckt</translation>
    </message>
    <message>
        <source>Fingertips occluded</source>
        <translation>Fingerspitzen verdeckt</translation>
    </message>
    <message>
        <source>{count} markers occluded</source>
        <translation>{count} Marker verdeckt</translation>
    </message>
    <message>
        <source>Turn the thumb side up</source>
        <translation>Daumenseite nach oben drehen</translation>
    </message>
    <message>
        <source>Raise the hand</source>
        <translation>Hand anheben</translation>
    </message>
    <message>
        <source>Turn the back of the fingers to the camera</source>
        <translation>Fingerrücken zur Kamera drehen</translation>
    </message>
    <message>
        <source>Forearm moved</source>
        <translation>Unterarm bewegt</translation>
    </message>
    <message>
        <source>Lay the forearm back where it was</source>
        <translation>Unterarm wieder zurücklegen</translation>
    </message>
    <message>
        <source>Wrist</source>
        <translation>Handgelenk</translation>
    </message>
    <message>
        <source>Index</source>
        <translation>Zeigefinger</translation>
    </message>
    <message>
        <source>Middle</source>
        <translation>Mittelfinger</translation>
    </message>
    <message>
        <source>Ring</source>
        <translation>Ringfinger</translation>
    </message>
    <message>
        <source>Little</source>
        <translation>Kleinfinger</translation>
    </message>
    <message>
        <source>Index finger</source>
        <translation>Zeigefinger</translation>
    </message>
    <message>
        <source>Middle finger</source>
        <translation>Mittelfinger</translation>
    </message>
    <message>
        <source>Ring finger</source>
        <translation>Ringfinger</translation>
    </message>
    <message>
        <source>Little finger</source>
        <translation>Kleinfinger</translation>
    </message>
    <message>
        <source>Click the {marker}</source>
        <translation>Anklicken: {marker}</translation>
    </message>
    <message>
        <source>At the base of the thumb, just distal to the anatomical snuffbox.</source>
        <translation>An der Daumenbasis, knapp distal der Tabatière.</translation>
    </message>
    <message>
        <source>On the back of the hand, 3–5 mm proximal to the MCP joint.</source>
        <translation>Auf dem Handrücken, 3–5 mm proximal des MCP-Gelenks.</translation>
    </message>
    <message>
        <source>Centred on the creases over the PIP joint.</source>
        <translation>Mitten auf den Falten über dem PIP-Gelenk.</translation>
    </message>
    <message>
        <source>Centred on the creases over the DIP joint.</source>
        <translation>Mitten auf den Falten über dem DIP-Gelenk.</translation>
    </message>
    <message>
        <source>Centred on the creases over the IP joint.</source>
        <translation>Mitten auf den Falten über dem IP-Gelenk.</translation>
    </message>
    <message>
        <source>Clear the view of the wrist</source>
        <translation>Sicht auf das Handgelenk freimachen</translation>
    </message>
    <message>
        <source>Turn the little-finger side up</source>
        <translation>Kleinfingerseite nach oben drehen</translation>
    </message>
    <message>
        <source>Accept {count} labels</source>
        <translation>{count} übernehmen</translation>
    </message>
    <message>
        <source>All {count} markers found</source>
        <translation>Alle {count} Marker gefunden</translation>
    </message>
    <message>
        <source>Are these labels correct?</source>
        <translation>Stimmen diese Bezeichnungen?</translation>
    </message>
    <message>
        <source>1 label is uncertain</source>
        <translation>1 Bezeichnung ist unsicher</translation>
    </message>
    <message>
        <source>{count} labels are uncertain</source>
        <translation>{count} Bezeichnungen sind unsicher</translation>
    </message>
    <message>
        <source>Check: {markers}. Press Enter to accept, or drag a label to another marker.</source>
        <translation>Prüfen: {markers}. Mit der Eingabetaste annehmen oder eine Bezeichnung auf einen anderen Marker ziehen.</translation>
    </message>
    <message>
        <source>Is this the {marker}?</source>
        <translation>Ist das „{marker}“?</translation>
    </message>
    <message>
        <source>Yes, it is</source>
        <translation>Ja, stimmt</translation>
    </message>
    <message>
        <source>{named} of {asked} markers found</source>
        <translation>{named} von {asked} Markern gefunden</translation>
    </message>
    <message>
        <source>Not found: {markers}. Press Enter to accept the others, then click these.</source>
        <translation>Nicht gefunden: {markers}. Mit der Eingabetaste die anderen übernehmen, dann diese anklicken.</translation>
    </message>
    <message>
        <source>{markers} and {count} more</source>
        <translation>{markers} und {count} weitere</translation>
    </message>
    <message>
        <source>1 file was saved.</source>
        <translation>1 Datei wurde gespeichert.</translation>
    </message>
    <message>
        <source>{count} files were saved.</source>
        <translation>{count} Dateien wurden gespeichert.</translation>
    </message>
    <message>
        <source>Folder: {folder}</source>
        <translation>Ordner: {folder}</translation>
    </message>
    <message>
        <source>Files: {names}</source>
        <translation>Dateien: {names}</translation>
    </message>
    <message>
        <source>Open folder</source>
        <translation>Ordner öffnen</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Enter</source>
        <translation>Eingabe</translation>
    </message>
    <message>
        <source>Markers</source>
        <translation>Marker</translation>
    </message>
    <message>
        <source>Camera tilt</source>
        <translation>Neigung</translation>
    </message>
    <message>
        <source>Hand</source>
        <translation>Hand</translation>
    </message>
    <message>
        <source>Hand length</source>
        <translation>Handlänge</translation>
    </message>
    <message>
        <source>labels wrong</source>
        <translation>Bezeichnung falsch</translation>
    </message>
    <message>
        <source>1 uncertain</source>
        <translation>1 unsicher</translation>
    </message>
    <message>
        <source>{count} not found</source>
        <translation>{count} nicht gefunden</translation>
    </message>
    <message>
        <source>within {size} mm</source>
        <translation>auf {size} mm genau</translation>
    </message>
    <message>
        <source>moved</source>
        <translation>bewegt</translation>
    </message>
    <message>
        <source>still, flat</source>
        <translation>ruhig, flach</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>Bereit</translation>
    </message>
    <message>
        <source>Cannot start yet</source>
        <translation>Start noch nicht möglich</translation>
    </message>
    <message>
        <source>ddd d MMM</source>
        <translation>ddd, d. MMM</translation>
    </message>
    <message>
        <source>d MMM</source>
        <translation>d. MMM</translation>
    </message>
    <message>
        <source>{minutes} min</source>
        <translation>{minutes} min</translation>
    </message>
    <message>
        <source>more than 99 h</source>
        <translation>mehr als 99 h</translation>
    </message>
    <message>
        <source>{hours} h</source>
        <translation>{hours} h</translation>
    </message>
    <message>
        <source>dddd d MMMM yyyy</source>
        <translation>dddd, d. MMMM yyyy</translation>
    </message>
    <message>
        <source>d MMM yyyy</source>
        <translation>d. MMM yyyy</translation>
    </message>
    <message>
        <source>1 week</source>
        <translation>1 Woche</translation>
    </message>
    <message>
        <source>{count} weeks</source>
        <translation>{count} Wochen</translation>
    </message>
    <message>
        <source>1 day</source>
        <translation>1 Tag</translation>
    </message>
    <message>
        <source>{count} days</source>
        <translation>{count} Tage</translation>
    </message>
    <message>
        <source>{number}st</source>
        <translation>{number}.</translation>
    </message>
    <message>
        <source>{number}nd</source>
        <translation>{number}.</translation>
    </message>
    <message>
        <source>{number}rd</source>
        <translation>{number}.</translation>
    </message>
    <message>
        <source>{number}th</source>
        <translation>{number}.</translation>
    </message>
    <message>
        <source>One moment.</source>
        <translation>Einen Moment.</translation>
    </message>
    <message>
        <source>Show the dots</source>
        <translation>Zeig die Punkte</translation>
    </message>
    <message>
        <source>Show the blue dots to the camera</source>
        <translation>Zeigen Sie der Kamera die blauen Punkte</translation>
    </message>
    <message>
        <source>Let your hand rest.</source>
        <translation>Lassen Sie die Hand ruhen.</translation>
    </message>
    <message>
        <source>A short break.</source>
        <translation>Kurze Pause.</translation>
    </message>
    <message>
        <source>Well done.</source>
        <translation>Gut gemacht.</translation>
    </message>
    <message>
        <source>Let your hand lie still</source>
        <translation>Lassen Sie die Hand ruhig liegen</translation>
    </message>
    <message>
        <source>Just try it.</source>
        <translation>Einfach probieren.</translation>
    </message>
    <message>
        <source>And back</source>
        <translation>Und zurück</translation>
    </message>
    <message>
        <source>There!</source>
        <translation>Geschafft!</translation>
    </message>
    <message>
        <source>As far as is comfortable</source>
        <translation>So weit, wie es angenehm ist</translation>
    </message>
    <message>
        <source>Further</source>
        <translation>Noch weiter</translation>
    </message>
    <message>
        <source>A little further</source>
        <translation>Noch ein wenig weiter</translation>
    </message>
    <message>
        <source>A few minutes</source>
        <translation>Ein paar Minuten</translation>
    </message>
    <message>
        <source>About a minute</source>
        <translation>Etwa eine Minute</translation>
    </message>
    <message>
        <source>About half a minute</source>
        <translation>Etwa eine halbe Minute</translation>
    </message>
    <message>
        <source>A moment longer</source>
        <translation>Noch einen Moment</translation>
    </message>
    <message>
        <source>then: {task}</source>
        <translation>dann: {task}</translation>
    </message>
    <message>
        <source>Bend your hand down</source>
        <translation>Beugen Sie die Hand nach unten</translation>
    </message>
    <message>
        <source>Lift your hand up</source>
        <translation>Heben Sie die Hand</translation>
    </message>
    <message>
        <source>Down</source>
        <translation>Runter</translation>
    </message>
    <message>
        <source>Up</source>
        <translation>Hoch</translation>
    </message>
    <message>
        <source>To the thumb</source>
        <translation>Zum Daumen</translation>
    </message>
    <message>
        <source>To the little finger</source>
        <translation>Zum kleinen Finger</translation>
    </message>
    <message>
        <source>Turn your palm up</source>
        <translation>Drehen Sie die Handfläche nach oben</translation>
    </message>
    <message>
        <source>Turn your palm down</source>
        <translation>Drehen Sie die Handfläche nach unten</translation>
    </message>
    <message>
        <source>Turn up</source>
        <translation>Nach oben drehen</translation>
    </message>
    <message>
        <source>Turn down</source>
        <translation>Nach unten drehen</translation>
    </message>
    <message>
        <source>Close your hand to a fist</source>
        <translation>Schließen Sie die Hand zur Faust</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Zur Faust</translation>
    </message>
    <message>
        <source>Bend your fingers into a hook</source>
        <translation>Beugen Sie die Finger zum Haken</translation>
    </message>
    <message>
        <source>Hook</source>
        <translation>Haken</translation>
    </message>
    <message>
        <source>Spread your fingers wide</source>
        <translation>Spreizen Sie die Finger weit</translation>
    </message>
    <message>
        <source>Wide</source>
        <translation>Finger spreizen</translation>
    </message>
    <message>
        <source>Open your thumb wide</source>
        <translation>Spreizen Sie den Daumen weit ab</translation>
    </message>
    <message>
        <source>Thumb wide</source>
        <translation>Daumen abspreizen</translation>
    </message>
    <message>
        <source>Take the cup, lift it a little, put it back</source>
        <translation>Nehmen Sie den Becher, heben Sie ihn etwas, stellen Sie ihn ab</translation>
    </message>
    <message>
        <source>Take the cup</source>
        <translation>Nimm den Becher</translation>
    </message>
    <message>
        <source>Move your fingers as you like</source>
        <translation>Bewegen Sie die Finger, wie Sie möchten</translation>
    </message>
    <message>
        <source>Move your fingers</source>
        <translation>Beweg die Finger</translation>
    </message>
    <message>
        <source>Move your hand as you like</source>
        <translation>Bewegen Sie die Hand, wie Sie möchten</translation>
    </message>
    <message>
        <source>Move your hand</source>
        <translation>Beweg die Hand</translation>
    </message>
    <message>
        <source>Turn your hand back</source>
        <translation>Drehen Sie die Hand zurück</translation>
    </message>
    <message>
        <source>Open your hand</source>
        <translation>Öffnen Sie die Hand</translation>
    </message>
    <message>
        <source>Straighten your fingers</source>
        <translation>Strecken Sie die Finger</translation>
    </message>
    <message>
        <source>Close your fingers</source>
        <translation>Schließen Sie die Finger</translation>
    </message>
    <message>
        <source>Touch the next fingertip</source>
        <translation>Berühren Sie die nächste Fingerspitze</translation>
    </message>
    <message>
        <source>Come back to the middle</source>
        <translation>Kommen Sie zurück zur Mitte</translation>
    </message>
    <message>
        <source>Try everything without a patient</source>
        <translation>Alles ohne Patient ausprobieren</translation>
    </message>
    <message>
        <source>No analysed session yet</source>
        <translation>Noch keine ausgewertete Sitzung</translation>
    </message>
    <message>
        <source>Carpus</source>
        <translation>Carpus</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>Limit {value}</source>
        <translation>Grenze {value}</translation>
    </message>
    <message>
        <source>Mean {value}</source>
        <translation>Mittel {value}</translation>
    </message>
    <message>
        <source>Carpus shows {what}</source>
        <translation>Carpus zeigt {what}</translation>
    </message>
    <message>
        <source>Carpus shows more {what}</source>
        <translation>Carpus zeigt mehr {what}</translation>
    </message>
    <message>
        <source>hatched: within the limit you set</source>
        <translation>schraffiert: innerhalb der eingestellten Grenze</translation>
    </message>
    <message>
        <source>seconds after the first frame</source>
        <translation>Sekunden nach dem ersten Bild</translation>
    </message>
    <message>
        <source>Reference, adults {span}</source>
        <translation>Ref. Erwachsene {span}</translation>
    </message>
    <message>
        <source>Total arc</source>
        <translation>Gesamtausmaß</translation>
    </message>
    <message>
        <source>Measurement error ±{gap}{limit}</source>
        <translation>Messfehler ±{gap}{limit}</translation>
    </message>
    <message>
        <source>Goal {angle}</source>
        <translation>Ziel {angle}</translation>
    </message>
    <message>
        <source>not compared</source>
        <translation>nicht verglichen</translation>
    </message>
    <message>
        <source>≥: partly occluded</source>
        <translation>≥: teilweise verdeckt</translation>
    </message>
    <message>
        <source>palm. abd.</source>
        <translation>Palm.-Abd.</translation>
    </message>
    <message>
        <source>{number} (excluded)</source>
        <translation>{number} (ausgeschl.)</translation>
    </message>
    <message>
        <source>{number} (passive)</source>
        <translation>{number} (passiv)</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Geschw.</translation>
    </message>
    <message>
        <source>no value</source>
        <translation>kein Wert</translation>
    </message>
    <message>
        <source>Flexion</source>
        <translation>Flexion</translation>
    </message>
    <message>
        <source>should stay within {angle}</source>
        <translation>soll innerhalb von {angle} bleiben</translation>
    </message>
    <message>
        <source>thumb ←</source>
        <translation>Daumen ←</translation>
    </message>
    <message>
        <source>thumb →</source>
        <translation>Daumen →</translation>
    </message>
    <message>
        <source>fingers ↑</source>
        <translation>Finger ↑</translation>
    </message>
    <message>
        <source>From above</source>
        <translation>Von oben</translation>
    </message>
    <message>
        <source>up ↑</source>
        <translation>oben ↑</translation>
    </message>
    <message>
        <source>fingers →</source>
        <translation>Finger →</translation>
    </message>
    <message>
        <source>From the side</source>
        <translation>Von der Seite</translation>
    </message>
    <message>
        <source>From the fingers</source>
        <translation>Von den Fingern aus</translation>
    </message>
    <message>
        <source>No sessions of this exercise yet.</source>
        <translation>Noch keine Sitzungen dieser Übung.</translation>
    </message>
    <message>
        <source>1 session is excluded.</source>
        <translation>1 Sitzung ist ausgeschlossen.</translation>
    </message>
    <message>
        <source>{count} sessions are excluded.</source>
        <translation>{count} Sitzungen sind ausgeschlossen.</translation>
    </message>
    <message>
        <source>Nothing to compare: {left_out}</source>
        <translation>Nichts zu vergleichen: {left_out}</translation>
    </message>
    <message>
        <source>At least two sessions are needed to show progress.</source>
        <translation>Für einen Verlauf sind mindestens zwei Sitzungen nötig.</translation>
    </message>
    <message>
        <source>Compare after the next session of the same kind.</source>
        <translation>Vergleichen Sie nach der nächsten Sitzung derselben Art.</translation>
    </message>
    <message>
        <source>at least {size}</source>
        <translation>mindestens {size}</translation>
    </message>
    <message>
        <source>TAM has improved in {count} of {all} fingers since {day}.</source>
        <translation>Die TAM ist seit dem {day} bei {count} von {all} Fingern besser.</translation>
    </message>
    <message>
        <source>{name} has improved by {size} since {day}.</source>
        <translation>{name} ist seit dem {day} um {size} besser.</translation>
    </message>
    <message>
        <source>{name} has decreased by {size} since {day}.</source>
        <translation>{name} hat seit dem {day} um {size} abgenommen.</translation>
    </message>
    <message>
        <source>Not assessed: the joints were partly occluded.</source>
        <translation>Nicht beurteilt: Die Gelenke waren teilweise verdeckt.</translation>
    </message>
    <message>
        <source>Not assessed: {why}.</source>
        <translation>Nicht beurteilt: {why}.</translation>
    </message>
    <message>
        <source>too few repetitions to compare</source>
        <translation>zu wenige Wiederholungen zum Vergleichen</translation>
    </message>
    <message>
        <source>{joint} of the {finger}</source>
        <translation>{joint} ({finger})</translation>
    </message>
    <message>
        <source>The total arc</source>
        <translation>Das Gesamtausmaß</translation>
    </message>
    <message>
        <source>From {before} to {after}: more than the measurement error of {limit}.</source>
        <translation>Von {before} auf {after}: mehr als der Messfehler von {limit}.</translation>
    </message>
    <message>
        <source>From {before} to {after}: within the measurement error of {limit}.</source>
        <translation>Von {before} auf {after}: innerhalb des Messfehlers von {limit}.</translation>
    </message>
    <message>
        <source>at least {change}</source>
        <translation>mindestens {change}</translation>
    </message>
    <message>
        <source>{name}: {change}.</source>
        <translation>{name}: {change}.</translation>
    </message>
    <message>
        <source>Excluded sessions and sessions with another set-up are not compared.</source>
        <translation>Ausgeschlossene Sitzungen und solche mit anderem Aufbau werden nicht verglichen.</translation>
    </message>
    <message>
        <source>partly occluded, or too few</source>
        <translation>teilweise verdeckt oder zu wenige Wdh.</translation>
    </message>
    <message>
        <source>{change}, MDC {limit}</source>
        <translation>{change}, MDC {limit}</translation>
    </message>
    <message>
        <source>{day}: measured although uncertain. {findings}</source>
        <translation>{day}: trotz Unsicherheit gemessen. {findings}</translation>
    </message>
    <message>
        <source>camera {step} cm further away</source>
        <translation>Kamera {step} cm weiter weg</translation>
    </message>
    <message>
        <source>camera {step} cm nearer</source>
        <translation>Kamera {step} cm näher</translation>
    </message>
    <message>
        <source>the forearm moved {distance}</source>
        <translation>Unterarm um {distance} verschoben</translation>
    </message>
    <message>
        <source>{day}: {reasons}. Excluded (shown as an open circle).</source>
        <translation>{day}: {reasons}. Ausgeschlossen (offener Kreis).</translation>
    </message>
    <message>
        <source>{day}: {reasons}. Excluded.</source>
        <translation>{day}: {reasons}. Ausgeschlossen.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Bilder</translation>
    </message>
    <message>
        <source>ext.</source>
        <translation>Ext.</translation>
    </message>
    <message>
        <source>flex.</source>
        <translation>Flex.</translation>
    </message>
    <message>
        <source>Movement time</source>
        <translation>Bewegungszeit</translation>
    </message>
    <message>
        <source>Peak speed</source>
        <translation>Maximalgeschwindigkeit</translation>
    </message>
    <message>
        <source>Time to peak</source>
        <translation>Zeit bis zum Maximum</translation>
    </message>
    <message>
        <source>Path length</source>
        <translation>Weglänge</translation>
    </message>
    <message>
        <source>Path length ratio</source>
        <translation>Verhältnis Weg/Gerade</translation>
    </message>
    <message>
        <source>Number of speed peaks</source>
        <translation>Anzahl der Geschwindigkeitsmaxima</translation>
    </message>
    <message>
        <source>Smoothness (SPARC)</source>
        <translation>Gleichmäßigkeit (SPARC)</translation>
    </message>
    <message>
        <source>Maximum grip aperture, thumb–index</source>
        <translation>Größte Greiföffnung, Daumen–Zeigefinger</translation>
    </message>
    <message>
        <source>Wrist angle at grasp</source>
        <translation>Handgelenkwinkel beim Greifen</translation>
    </message>
    <message>
        <source>Hand span, thumb–little</source>
        <translation>Handspanne, Daumen–Kleinfinger</translation>
    </message>
    <message>
        <source>Movement synergy (variance explained)</source>
        <translation>Bewegungssynergie (erklärte Varianz)</translation>
    </message>
    <message>
        <source>Tremor, 3 to 12 Hz (rms)</source>
        <translation>Tremor, 3 bis 12 Hz (rms)</translation>
    </message>
    <message>
        <source>index</source>
        <translation>Zeigef.</translation>
    </message>
    <message>
        <source>ring</source>
        <translation>Ringf.</translation>
    </message>
    <message>
        <source>little</source>
        <translation>Kleinf.</translation>
    </message>
    <message>
        <source>Largest span, {one}–{other}</source>
        <translation>Größte Spanne, {one}–{other}</translation>
    </message>
    <message>
        <source>Smallest distance, {one}–{other}</source>
        <translation>Kleinster Abstand, {one}–{other}</translation>
    </message>
    <message>
        <source>Touches, {one}–{other}</source>
        <translation>Berührungen {one}–{other}</translation>
    </message>
    <message>
        <source>occluded</source>
        <translation>verdeckt</translation>
    </message>
    <message>
        <source>Reach {time}, peak speed {speed}, path ratio {straight}, grip aperture {opening}, wrist {wrist}</source>
        <translation>Reichbewegung {time}, Maximalgeschwindigkeit {speed}, Verhältnis Weg/Gerade {straight}, Greiföffnung {opening}, Handgelenk {wrist}</translation>
    </message>
    <message>
        <source>The thumb touched {met} of {all} fingertips</source>
        <translation>Der Daumen berührte {met} von {all} Fingerspitzen</translation>
    </message>
    <message>
        <source>Thumb contact was occluded</source>
        <translation>Der Daumenkontakt war verdeckt</translation>
    </message>
    <message>
        <source>{words}; {hidden} occluded</source>
        <translation>{words}; {hidden} verdeckt</translation>
    </message>
    <message>
        <source>Reach {time}</source>
        <translation>Reichbewegung {time}</translation>
    </message>
    <message>
        <source>Reach and grasp</source>
        <translation>Reichen und Greifen</translation>
    </message>
    <message>
        <source>Thumb to the fingertips</source>
        <translation>Daumen zu den Fingerspitzen</translation>
    </message>
    <message>
        <source>Spans</source>
        <translation>Spannweiten</translation>
    </message>
    <message>
        <source>Finger coordination</source>
        <translation>Fingerkoordination</translation>
    </message>
    <message>
        <source>Additional measures</source>
        <translation>Weitere Maße</translation>
    </message>
    <message>
        <source>Range of motion of the fingers</source>
        <translation>Bewegungsausmaß der Finger</translation>
    </message>
    <message>
        <source>not visible</source>
        <translation>nicht sichtbar</translation>
    </message>
    <message>
        <source>dashed: occluded; hatched: lost</source>
        <translation>gestrichelt: verdeckt; schraffiert: nicht erfasst</translation>
    </message>
    <message>
        <source>Finger flexion over time</source>
        <translation>Fingerflexion über die Zeit</translation>
    </message>
    <message>
        <source>PIP (thumb: palmar abduction)</source>
        <translation>PIP (Daumen: Palmarabduktion)</translation>
    </message>
    <message>
        <source>not graded</source>
        <translation>nicht eingestuft</translation>
    </message>
    <message>
        <source>excellent</source>
        <translation>sehr gut</translation>
    </message>
    <message>
        <source>good</source>
        <translation>gut</translation>
    </message>
    <message>
        <source>fair</source>
        <translation>mäßig</translation>
    </message>
    <message>
        <source>poor</source>
        <translation>schlecht</translation>
    </message>
    <message>
        <source>Total (TAM)</source>
        <translation>Gesamt (TAM)</translation>
    </message>
    <message>
        <source>% of other hand</source>
        <translation>% der anderen Hand</translation>
    </message>
    <message>
        <source>% of reference</source>
        <translation>% der Referenz</translation>
    </message>
    <message>
        <source>{what}, {day}</source>
        <translation>{what}, {day}</translation>
    </message>
    <message>
        <source>Change since {day}</source>
        <translation>Änderung seit {day}</translation>
    </message>
    <message>
        <source>palmar abduction of the thumb</source>
        <translation>Palmarabduktion des Daumens</translation>
    </message>
    <message>
        <source>MCP of {fingers}</source>
        <translation>MCP: {fingers}</translation>
    </message>
    <message>
        <source>PIP of {fingers}</source>
        <translation>PIP: {fingers}</translation>
    </message>
    <message>
        <source>DIP of {fingers}</source>
        <translation>DIP: {fingers}</translation>
    </message>
    <message>
        <source>all fingers</source>
        <translation>alle Finger</translation>
    </message>
    <message>
        <source>Not visible: {joints}.</source>
        <translation>Nicht sichtbar: {joints}.</translation>
    </message>
    <message>
        <source>Total active motion (TAM): a finger’s largest total flexion minus its smallest, with all joints visible.</source>
        <translation>Aktive Gesamtbeweglichkeit (TAM): größte Flexionssumme eines Fingers minus die kleinste, bei sichtbaren Gelenken.</translation>
    </message>
    <message>
        <source>No total active motion (TAM): no finger had all joints visible at once.</source>
        <translation>Aktive Gesamtbeweglichkeit (TAM) nicht bestimmbar: Bei keinem Finger waren alle Gelenke zugleich sichtbar.</translation>
    </message>
    <message>
        <source>PIP joints</source>
        <translation>PIP-Gelenke</translation>
    </message>
    <message>
        <source>{what}: {fingers}.</source>
        <translation>{what}: {fingers}.</translation>
    </message>
    <message>
        <source>{sign}: the end of this movement was occluded.</source>
        <translation>{sign}: Das Ende dieser Bewegung war verdeckt.</translation>
    </message>
    <message>
        <source>the first session on {day}</source>
        <translation>Tag der ersten Sitzung ({day})</translation>
    </message>
    <message>
        <source>Change since {when} is not assessed: {why}.</source>
        <translation>Änderung seit dem {when} nicht beurteilt: {why}.</translation>
    </message>
    <message>
        <source>Partly occluded joints are not assessed.</source>
        <translation>Teilweise verdeckte Gelenke werden nicht beurteilt.</translation>
    </message>
    <message>
        <source>Since {when}: {changes} (MDC {limit}).</source>
        <translation>Seit dem {when}: {changes} (MDC {limit}).</translation>
    </message>
    <message>
        <source>IP</source>
        <translation>IP</translation>
    </message>
    <message>
        <source>not measured</source>
        <translation>nicht gemessen</translation>
    </message>
    <message>
        <source>not assessed: {why}</source>
        <translation>nicht beurteilt: {why}</translation>
    </message>
    <message>
        <source>flexion {full}, deficit {missing}</source>
        <translation>Flexion {full}, Streckdefizit {missing}</translation>
    </message>
    <message>
        <source>TAM of all fingers</source>
        <translation>TAM aller Finger</translation>
    </message>
    <message>
        <source>Palmar and radial abduction of the thumb</source>
        <translation>Palmar- und Radialabduktion des Daumens</translation>
    </message>
    <message>
        <source>Path of the wrist</source>
        <translation>Bahn des Handgelenks</translation>
    </message>
    <message>
        <source>joint centres; dashed: marker occluded</source>
        <translation>Gelenkmitten; gestrichelt: Marker verdeckt</translation>
    </message>
    <message>
        <source>Fingertip paths</source>
        <translation>Bahnen der Fingerspitzen</translation>
    </message>
    <message>
        <source>X (black) to the fingers, Y (blue) to the thumb, Z (orange) up</source>
        <translation>X (schwarz) zu den Fingern, Y (blau) zum Daumen, Z (orange) nach oben</translation>
    </message>
    <message>
        <source>X (black) to the fingers, Y (blue) away from the thumb, Z (orange) up</source>
        <translation>X (schwarz) zu den Fingern, Y (blau) vom Daumen weg, Z (orange) nach oben</translation>
    </message>
    <message>
        <source>ZYZ angles</source>
        <translation>ZYZ-Winkel</translation>
    </message>
    <message>
        <source>Progress report</source>
        <translation>Verlaufsbericht</translation>
    </message>
    <message>
        <source>Sessions</source>
        <translation>Sitzungen</translation>
    </message>
    <message>
        <source>First</source>
        <translation>Erste</translation>
    </message>
    <message>
        <source>Last</source>
        <translation>Letzte</translation>
    </message>
    <message>
        <source>Therapist</source>
        <translation>Therapeut/in</translation>
    </message>
    <message>
        <source>1 session: {ids}</source>
        <translation>1 Sitzung: {ids}</translation>
    </message>
    <message>
        <source>{count} sessions: {ids}</source>
        <translation>{count} Sitzungen: {ids}</translation>
    </message>
    <message>
        <source>{before} and {after} repetitions</source>
        <translation>{before} und {after} Wiederholungen</translation>
    </message>
    <message>
        <source>First to last session</source>
        <translation>Erste bis letzte Sitzung</translation>
    </message>
    <message>
        <source>not combined with the values above</source>
        <translation>nicht mit den Werten oben verrechnet</translation>
    </message>
    <message>
        <source>Comparability</source>
        <translation>Vergleichbarkeit</translation>
    </message>
    <message>
        <source>All sessions used the same set-up.</source>
        <translation>Alle Sitzungen hatten den gleichen Aufbau.</translation>
    </message>
    <message>
        <source>Session report</source>
        <translation>Sitzungsbericht</translation>
    </message>
    <message>
        <source>SIMULATED</source>
        <translation>SIMULIERT</translation>
    </message>
    <message>
        <source>active and passive</source>
        <translation>aktiv und passiv</translation>
    </message>
    <message>
        <source>right-handed</source>
        <translation>rechtshändig</translation>
    </message>
    <message>
        <source>left-handed</source>
        <translation>linkshändig</translation>
    </message>
    <message>
        <source>both-handed</source>
        <translation>beidhändig</translation>
    </message>
    <message>
        <source>Date</source>
        <translation>Datum</translation>
    </message>
    <message>
        <source>Session</source>
        <translation>Sitzung</translation>
    </message>
    <message>
        <source>Range of motion</source>
        <translation>Bewegungsausmaß</translation>
    </message>
    <message>
        <source>Active and passive</source>
        <translation>Aktiv und passiv</translation>
    </message>
    <message>
        <source>dashed: goal</source>
        <translation>gestrichelt: Ziel</translation>
    </message>
    <message>
        <source>Angles over time</source>
        <translation>Winkel über die Zeit</translation>
    </message>
    <message>
        <source>Pronation–supination</source>
        <translation>Pro-/Supination</translation>
    </message>
    <message>
        <source>Today</source>
        <translation>Heute</translation>
    </message>
    <message>
        <source>How reliable are these values?</source>
        <translation>Wie zuverlässig sind diese Werte?</translation>
    </message>
    <message>
        <source>The therapist’s comment is on the last page.</source>
        <translation>Der therapeutische Kommentar steht auf der letzten Seite.</translation>
    </message>
    <message>
        <source>Movement measured by camera: {who}</source>
        <translation>Bewegungsmessung mit der Kamera: {who}</translation>
    </message>
    <message>
        <source>Dear colleague,</source>
        <translation>Sehr geehrte Damen und Herren,</translation>
    </message>
    <message>
        <source>On {day} we measured: {exercise}, {hand}. Repetitions analysed: {count}.</source>
        <translation>am {day} haben wir gemessen: {exercise}, {hand}. Ausgewertete Wiederholungen: {count}.</translation>
    </message>
    <message>
        <source>Kind regards,</source>
        <translation>Mit freundlichen Grüßen</translation>
    </message>
    <message>
        <source>Signature</source>
        <translation>Unterschrift</translation>
    </message>
    <message>
        <source>Session {id}</source>
        <translation>Sitzung {id}</translation>
    </message>
    <message>
        <source>settings {digest}</source>
        <translation>Einstellungen {digest}</translation>
    </message>
    <message>
        <source>data {digest}</source>
        <translation>Daten {digest}</translation>
    </message>
    <message>
        <source>recording {digest}</source>
        <translation>Aufnahme {digest}</translation>
    </message>
    <message>
        <source>smoothed</source>
        <translation>geglättet</translation>
    </message>
    <message>
        <source>Movement</source>
        <translation>Bewegung</translation>
    </message>
    <message>
        <source>Best</source>
        <translation>Bestwert</translation>
    </message>
    <message>
        <source>Reference (adults)</source>
        <translation>Referenz (Erw.)</translation>
    </message>
    <message>
        <source>1 repetition</source>
        <translation>1 Wiederholung</translation>
    </message>
    <message>
        <source>mean of {count} repetitions</source>
        <translation>Mittel aus {count} Wiederholungen</translation>
    </message>
    <message>
        <source>no active repetition</source>
        <translation>keine aktive Wiederholung</translation>
    </message>
    <message>
        <source>plus 1 passive</source>
        <translation>zusätzlich 1 passive</translation>
    </message>
    <message>
        <source>plus {count} passive</source>
        <translation>zusätzlich {count} passive</translation>
    </message>
    <message>
        <source>not visible enough</source>
        <translation>nicht ausreichend sichtbar</translation>
    </message>
    <message>
        <source>cut off at the start of the recording</source>
        <translation>am Anfang der Aufnahme abgeschnitten</translation>
    </message>
    <message>
        <source>the hand left the camera’s view</source>
        <translation>die Hand verließ das Kamerabild</translation>
    </message>
    <message>
        <source>cut off at the end of the recording</source>
        <translation>am Ende der Aufnahme abgeschnitten</translation>
    </message>
    <message>
        <source>passive repetitions excluded</source>
        <translation>passive Wiederholungen ausgeschlossen</translation>
    </message>
    <message>
        <source>range over the whole recording; no repetitions</source>
        <translation>Bewegungsausmaß über die ganze Aufnahme; keine Wiederholungen</translation>
    </message>
    <message>
        <source>the exercised joint was not visible</source>
        <translation>das geübte Gelenk war nicht sichtbar</translation>
    </message>
    <message>
        <source>less than 10° of movement</source>
        <translation>weniger als 10° Bewegung</translation>
    </message>
    <message>
        <source>no complete movement cycle</source>
        <translation>kein vollständiger Bewegungszyklus</translation>
    </message>
    <message>
        <source>{seconds} s occluded and not analysed</source>
        <translation>{seconds} s verdeckt und nicht ausgewertet</translation>
    </message>
    <message>
        <source>{angle} at most</source>
        <translation>höchstens {angle}</translation>
    </message>
    <message>
        <source>under {angle}</source>
        <translation>unter {angle}</translation>
    </message>
    <message>
        <source>more than intended: check the exercise technique</source>
        <translation>mehr als vorgesehen: Ausführung prüfen</translation>
    </message>
    <message>
        <source>total arc</source>
        <translation>Gesamtausmaß</translation>
    </message>
    <message>
        <source>{name} improved by {size}</source>
        <translation>{name} um {size} besser</translation>
    </message>
    <message>
        <source>{name} decreased by {size}</source>
        <translation>{name} um {size} verringert</translation>
    </message>
    <message>
        <source>(MDC {limit})</source>
        <translation>(MDC {limit})</translation>
    </message>
    <message>
        <source>Since {when}: {changes}.</source>
        <translation>Seit dem {when}: {changes}.</translation>
    </message>
    <message>
        <source>Fingers: 0° = straight; negative = hyperextension. Wrist: {zero}.</source>
        <translation>Finger: 0° = gestreckt; negativ = Überstreckung. Handgelenk: {zero}.</translation>
    </message>
    <message>
        <source>Fingers: 0° = straight; negative = hyperextension. TAM = total flexion minus extension deficit. Wrist: {zero}.</source>
        <translation>Finger: 0° = gestreckt; negativ = Überstreckung. TAM = Gesamtflexion minus Streckdefizit. Handgelenk: {zero}.</translation>
    </message>
    <message>
        <source>0° set by goniometer, start position {angles}</source>
        <translation>0° mit dem Goniometer bestimmt, Ausgangsstellung {angles}</translation>
    </message>
    <message>
        <source>Method: {markers} markers, colour and depth camera, {distance} away.</source>
        <translation>Verfahren: {markers} Marker, Farb- und Tiefenkamera, {distance} entfernt.</translation>
    </message>
    <message>
        <source>Angles are relative to the room. They equal wrist angles only while the forearm is still.</source>
        <translation>Die Winkel gelten relativ zum Raum. Sie entsprechen den Handgelenkwinkeln nur, solange der Unterarm ruht.</translation>
    </message>
    <message>
        <source>Camera not calibrated with a board.</source>
        <translation>Kamera nicht mit einer Tafel kalibriert.</translation>
    </message>
    <message>
        <source>Camera calibrated {day}.</source>
        <translation>Kamera kalibriert am {day}.</translation>
    </message>
    <message>
        <source>Camera calibrated {day}, {days} days before.</source>
        <translation>Kamera kalibriert am {day}, {days} Tage zuvor.</translation>
    </message>
    <message>
        <source>Simulated data: no patient was measured.</source>
        <translation>Simulierte Daten: keine Messung an einem Patienten.</translation>
    </message>
    <message>
        <source>Measured although uncertain: {findings}</source>
        <translation>Trotz Unsicherheit gemessen: {findings}</translation>
    </message>
    <message>
        <source>This session is excluded from analysis.</source>
        <translation>Diese Sitzung ist von der Auswertung ausgeschlossen.</translation>
    </message>
    <message>
        <source>An older result: there is a newer one of the same recording.</source>
        <translation>Älteres Ergebnis: Von derselben Aufnahme gibt es ein neueres.</translation>
    </message>
    <message>
        <source>This recording was cut short and recovered.</source>
        <translation>Diese Aufnahme wurde unterbrochen und wiederhergestellt.</translation>
    </message>
    <message>
        <source>Warning</source>
        <translation>Warnung</translation>
    </message>
    <message>
        <source>at the top of the page</source>
        <translation>oben auf der Seite</translation>
    </message>
    <message>
        <source>Corrected on {day}, from {time}, by {who}.</source>
        <translation>Korrigiert am {day}, ab Aufnahmezeit {time}, von {who}.</translation>
    </message>
    <message>
        <source>Corrected on {day}, from {time}.</source>
        <translation>Korrigiert am {day}, ab Aufnahmezeit {time}.</translation>
    </message>
    <message>
        <source>{share} % of the time</source>
        <translation>{share} % der Zeit</translation>
    </message>
    <message>
        <source>Frames measured</source>
        <translation>Gemessene Bilder</translation>
    </message>
    <message>
        <source>Markers occluded</source>
        <translation>Verdeckte Marker</translation>
    </message>
    <message>
        <source>{count} of {all} values</source>
        <translation>{count} von {all} Werten</translation>
    </message>
    <message>
        <source>Minimum (≥) or not visible</source>
        <translation>Mindestwert (≥) oder nicht sichtbar</translation>
    </message>
    <message>
        <source>{distance} (limit {limit})</source>
        <translation>{distance} (Grenze {limit})</translation>
    </message>
    <message>
        <source>Wrist rotation centre</source>
        <translation>Drehpunkt des Handgelenks</translation>
    </message>
    <message>
        <source>{angle} at most (limit {limit})</source>
        <translation>höchstens {angle} (Grenze {limit})</translation>
    </message>
    <message>
        <source>Smoothness (SPARC; closer to 0 is smoother)</source>
        <translation>Gleichmäßigkeit (SPARC; näher an 0 ist besser)</translation>
    </message>
    <message>
        <source>Goal</source>
        <translation>Ziel</translation>
    </message>
    <message>
        <source>Pain first / last (0–10)</source>
        <translation>Schmerz Beginn / Ende (0–10)</translation>
    </message>
    <message>
        <source>Pain (0–10)</source>
        <translation>Schmerz (0–10)</translation>
    </message>
    <message>
        <source>not asked</source>
        <translation>nicht erfragt</translation>
    </message>
    <message>
        <source>{pain} at {time}</source>
        <translation>{pain} bei {time}</translation>
    </message>
    <message>
        <source>Values of a simulated hand are never used.</source>
        <translation>Werte einer simulierten Hand werden nie verwendet.</translation>
    </message>
    <message>
        <source>Not usable yet: at least {count} people are needed, 20 are better.</source>
        <translation>Noch nicht verwendbar: Mindestens {count} Personen sind nötig, besser 20.</translation>
    </message>
    <message>
        <source>Excluded: {sessions}.</source>
        <translation>Ausgeschlossen: {sessions}.</translation>
    </message>
    <message>
        <source>more than 14 days later</source>
        <translation>mehr als 14 Tage später</translation>
    </message>
    <message>
        <source>missing</source>
        <translation>fehlt</translation>
    </message>
    <message>
        <source>cannot be read</source>
        <translation>nicht lesbar</translation>
    </message>
    <message>
        <source>Measured by this clinic: {exercise}</source>
        <translation>Im eigenen Haus gemessen: {exercise}</translation>
    </message>
    <message>
        <source>SEM {size}</source>
        <translation>SEM {size}</translation>
    </message>
    <message>
        <source>Flexion, extension</source>
        <translation>Flexion, Extension</translation>
    </message>
    <message>
        <source>Radial, ulnar deviation</source>
        <translation>Radial-, Ulnarduktion</translation>
    </message>
    <message>
        <source>Supination, pronation</source>
        <translation>Supination, Pronation</translation>
    </message>
    <message>
        <source>{exercise}, {count} times</source>
        <translation>{exercise}, {count}-mal</translation>
    </message>
    <message>
        <source>{exercise}, {count} s</source>
        <translation>{exercise}, {count} s</translation>
    </message>
    <message>
        <source>Wrist flexion–extension</source>
        <translation>Handgelenk Flexion–Extension</translation>
    </message>
    <message>
        <source>Free movement</source>
        <translation>Freie Bewegung</translation>
    </message>
    <message>
        <source>Full fist</source>
        <translation>Faustschluss</translation>
    </message>
    <message>
        <source>Hook fist</source>
        <translation>Hakenfaust</translation>
    </message>
    <message>
        <source>Spread the fingers</source>
        <translation>Finger spreizen</translation>
    </message>
    <message>
        <source>Thumb opposition</source>
        <translation>Daumenopposition</translation>
    </message>
    <message>
        <source>Free movement of the fingers</source>
        <translation>Freie Bewegung der Finger</translation>
    </message>
    <message>
        <source>Whole hand · {count} markers</source>
        <translation>Ganze Hand · {count} Marker</translation>
    </message>
    <message>
        <source>Some fingers · {count} markers</source>
        <translation>Einige Finger · {count} Marker</translation>
    </message>
    <message>
        <source>Wrist · {count} markers</source>
        <translation>Handgelenk · {count} Marker</translation>
    </message>
    <message>
        <source>operated on {day}</source>
        <translation>operiert am {day}</translation>
    </message>
    <message>
        <source>injured on {day}</source>
        <translation>verletzt am {day}</translation>
    </message>
    <message>
        <source>Turn the palm up as far as the markers stay visible, then back.</source>
        <translation>Die Handfläche nach oben drehen, soweit die Marker sichtbar bleiben, dann zurück.</translation>
    </message>
    <message>
        <source>Move the wrist freely. All three angles are recorded; no repetitions are counted.</source>
        <translation>Das Handgelenk frei bewegen. Alle drei Winkel werden aufgenommen; Wiederholungen werden nicht gezählt.</translation>
    </message>
    <message>
        <source>Close all fingers into a full fist, then open flat.</source>
        <translation>Alle Finger zur Faust schließen, dann flach öffnen.</translation>
    </message>
    <message>
        <source>Spread the fingers wide, then close them.</source>
        <translation>Die Finger weit spreizen, dann schließen.</translation>
    </message>
    <message>
        <source>Touch each fingertip with the thumb in turn. Abduct the thumb fully in between.</source>
        <translation>Mit dem Daumen nacheinander jede Fingerspitze berühren, dazwischen den Daumen ganz abspreizen.</translation>
    </message>
    <message>
        <source>Reach, take the cup, lift it a little, put it back, return.</source>
        <translation>Die Hand zum Becher führen, ihn nehmen, etwas anheben, abstellen, zurück.</translation>
    </message>
    <message>
        <source>Move the fingers freely. All joint angles are recorded; no repetitions are counted.</source>
        <translation>Die Finger frei bewegen. Alle Gelenkwinkel werden aufgenommen; Wiederholungen werden nicht gezählt.</translation>
    </message>
    <message>
        <source>Forearm on a 10 cm wedge, palm down, hand over the edge, fingers relaxed.</source>
        <translation>Unterarm auf einem 10-cm-Keil, Handfläche nach unten, Hand über der Kante, Finger locker.</translation>
    </message>
    <message>
        <source>Palm flat on a smooth sheet, forearm strapped.</source>
        <translation>Handfläche flach auf glatter Unterlage, Unterarm fixiert.</translation>
    </message>
    <message>
        <source>Elbow at the side, forearm free, palm down under the camera.</source>
        <translation>Ellenbogen am Körper, Unterarm frei, Handfläche nach unten unter der Kamera.</translation>
    </message>
    <message>
        <source>Hand in view of the camera, back of the hand up.</source>
        <translation>Hand im Blickfeld der Kamera, Handrücken nach oben.</translation>
    </message>
    <message>
        <source>Forearm on the wedge, back of the hand towards the camera, fingers straight.</source>
        <translation>Unterarm auf dem Keil, Handrücken zur Kamera, Finger gestreckt.</translation>
    </message>
    <message>
        <source>Palm flat on the table, fingers straight and closed.</source>
        <translation>Handfläche flach auf dem Tisch, Finger gestreckt und geschlossen.</translation>
    </message>
    <message>
        <source>Forearm on the wedge, thumb side turned up a little, fingers relaxed.</source>
        <translation>Unterarm auf dem Keil, Daumenseite etwas nach oben gedreht, Finger locker.</translation>
    </message>
    <message>
        <source>Hand in view of the camera, back of the hand up, fingers straight.</source>
        <translation>Hand im Blickfeld der Kamera, Handrücken nach oben, Finger gestreckt.</translation>
    </message>
    <message>
        <source>Legal notice, in its English wording:</source>
        <translation>Rechtlicher Hinweis, im englischen Wortlaut:</translation>
    </message>
    <message>
        <source>Radial</source>
        <translation>Radial</translation>
    </message>
    <message>
        <source>Ulnar</source>
        <translation>Ulnar</translation>
    </message>
    <message>
        <source>Extension</source>
        <translation>Extension</translation>
    </message>
    <message>
        <source>Supination</source>
        <translation>Supination</translation>
    </message>
    <message>
        <source>Pronation</source>
        <translation>Pronation</translation>
    </message>
    <message>
        <source>Radial deviation deficit</source>
        <translation>Defizit Radialduktion</translation>
    </message>
    <message>
        <source>Ulnar deviation deficit</source>
        <translation>Defizit Ulnarduktion</translation>
    </message>
    <message>
        <source>Flexion deficit</source>
        <translation>Beugedefizit</translation>
    </message>
    <message>
        <source>Extension deficit</source>
        <translation>Streckdefizit</translation>
    </message>
    <message>
        <source>Supination deficit</source>
        <translation>Supinationsdefizit</translation>
    </message>
    <message>
        <source>Pronation deficit</source>
        <translation>Pronationsdefizit</translation>
    </message>
    <message>
        <source>{angle} deficit</source>
        <translation>Defizit {angle}</translation>
    </message>
    <message>
        <source>Radial deviation</source>
        <translation>Radialduktion</translation>
    </message>
    <message>
        <source>Ulnar deviation</source>
        <translation>Ulnarduktion</translation>
    </message>
    <message>
        <source>Right hand</source>
        <translation>Rechte Hand</translation>
    </message>
    <message>
        <source>Left hand</source>
        <translation>Linke Hand</translation>
    </message>
    <message>
        <source>Both hands</source>
        <translation>Beide Hände</translation>
    </message>
    <message>
        <source>Right</source>
        <translation>Rechts</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>Links</translation>
    </message>
    <message>
        <source>Both</source>
        <translation>Beide</translation>
    </message>
    <message>
        <source>Right hand affected</source>
        <translation>Rechte Hand betroffen</translation>
    </message>
    <message>
        <source>Left hand affected</source>
        <translation>Linke Hand betroffen</translation>
    </message>
    <message>
        <source>Both hands affected</source>
        <translation>Beide Hände betroffen</translation>
    </message>
    <message>
        <source>Choose the image source, then continue here.</source>
        <translation>Wählen Sie die Bildquelle, dann geht es hier weiter.</translation>
    </message>
    <message>
        <source>Take the image when the hand lies flat and every marker is visible.</source>
        <translation>Das Bild aufnehmen, wenn die Hand flach liegt und alle Marker sichtbar sind.</translation>
    </message>
    <message>
        <source>The joints are already tracked. The space bar starts the recording.</source>
        <translation>Die Gelenke werden bereits erfasst. Die Leertaste startet die Aufnahme.</translation>
    </message>
    <message>
        <source>Let the hand move a few times. Then press the space bar to stop and save.</source>
        <translation>Lassen Sie den Patienten die Hand einige Male bewegen. Dann beendet und speichert die Leertaste die Aufzeichnung.</translation>
    </message>
    <message>
        <source>These are the results. The key X excludes the current repetition.</source>
        <translation>Das sind die Ergebnisse. Die Taste X schließt die angezeigte Wiederholung aus.</translation>
    </message>
    <message>
        <source>Make the report of this session here.</source>
        <translation>Erstellen Sie hier den Bericht dieser Sitzung.</translation>
    </message>
    <message>
        <source>the other hand</source>
        <translation>andere Hand</translation>
    </message>
    <message>
        <source>other markers</source>
        <translation>andere Marker</translation>
    </message>
    <message>
        <source>another exercise</source>
        <translation>andere Übung</translation>
    </message>
    <message>
        <source>fewer than 3 repetitions</source>
        <translation>weniger als 3 Wiederholungen</translation>
    </message>
    <message>
        <source>a simulated hand</source>
        <translation>simulierte Hand</translation>
    </message>
    <message>
        <source>excluded from analysis</source>
        <translation>von der Auswertung ausgeschlossen</translation>
    </message>
    <message>
        <source>measured although the markers were uncertain</source>
        <translation>trotz unsicherer Marker gemessen</translation>
    </message>
    <message>
        <source>the camera was at another distance</source>
        <translation>die Kamera hatte einen anderen Abstand</translation>
    </message>
    <message>
        <source>another start angle was given</source>
        <translation>eine andere Ausgangsstellung war angegeben</translation>
    </message>
    <message>
        <source>the forearm moved</source>
        <translation>der Unterarm hat sich bewegt</translation>
    </message>
    <message>
        <source>angles in another order</source>
        <translation>Winkel in anderer Reihenfolge</translation>
    </message>
    <message>
        <source>Only the newest result of a recording is analysed: 1 earlier result is excluded.</source>
        <translation>Nur das neueste Ergebnis einer Aufnahme wird ausgewertet: 1 früheres ist ausgeschlossen.</translation>
    </message>
    <message>
        <source>Only the newest result of a recording is analysed: {count} earlier results are excluded.</source>
        <translation>Nur das neueste Ergebnis einer Aufnahme wird ausgewertet: {count} frühere sind ausgeschlossen.</translation>
    </message>
    <message>
        <source>{size} more</source>
        <translation>{size} mehr</translation>
    </message>
    <message>
        <source>{size} less</source>
        <translation>{size} weniger</translation>
    </message>
    <message>
        <source>{difference}, within MDC ({limit})</source>
        <translation>{difference}, innerhalb der MDC ({limit})</translation>
    </message>
    <message>
        <source>{difference}, beyond MDC ({limit})</source>
        <translation>{difference}, über der MDC ({limit})</translation>
    </message>
    <message>
        <source>Another blue spot is close to the {markers}: it may be the marker.</source>
        <translation>{markers}: Dicht daneben liegt eine andere blaue Stelle, die der Marker sein könnte.</translation>
    </message>
    <message>
        <source>Update the firmware with the manufacturer’s RealSense Viewer.</source>
        <translation>Aktualisieren Sie die Firmware mit dem RealSense Viewer des Herstellers.</translation>
    </message>
    <message>
        <source>Carpus cannot write to {subject} ({detail}).</source>
        <translation>Carpus kann in {subject} nicht schreiben ({detail}).</translation>
    </message>
    <message>
        <source>Check that a marker was clicked there, and not another blue spot.</source>
        <translation>Prüfen Sie, ob dort ein Marker angeklickt wurde und keine andere blaue Stelle.</translation>
    </message>
    <message>
        <source>Check that every marker is clicked under its own label.</source>
        <translation>Prüfen Sie, ob jeder Marker unter seiner Bezeichnung angeklickt ist.</translation>
    </message>
    <message>
        <source>Check the name and the folder.</source>
        <translation>Prüfen Sie den Namen und den Ordner.</translation>
    </message>
    <message>
        <source>Check the patient, the side, and that every marker is clicked under its own label.</source>
        <translation>Prüfen Sie Patient und Seite, und ob jeder Marker unter seiner Bezeichnung angeklickt ist.</translation>
    </message>
    <message>
        <source>Choose a folder on another disk.</source>
        <translation>Wählen Sie einen Ordner auf einem anderen Datenträger.</translation>
    </message>
    <message>
        <source>Choose another name.</source>
        <translation>Wählen Sie einen anderen Namen.</translation>
    </message>
    <message>
        <source>Choose another recording, or record again.</source>
        <translation>Wählen Sie eine andere Aufnahme, oder machen Sie eine neue.</translation>
    </message>
    <message>
        <source>Choose the other side, or click the markers again.</source>
        <translation>Wählen Sie die andere Seite, oder klicken Sie die Marker neu an.</translation>
    </message>
    <message>
        <source>Click all markers again, each under its own label.</source>
        <translation>Klicken Sie alle Marker neu an, jeden unter seiner Bezeichnung.</translation>
    </message>
    <message>
        <source>Click each of the two on its own marker.</source>
        <translation>Klicken Sie für beide Bezeichnungen jeweils den zugehörigen Marker an.</translation>
    </message>
    <message>
        <source>Click nearer to the marker, or check the light.</source>
        <translation>Klicken Sie näher am Marker, oder prüfen Sie das Licht.</translation>
    </message>
    <message>
        <source>Clock</source>
        <translation>Uhr</translation>
    </message>
    <message>
        <source>Close the other program that uses the camera.</source>
        <translation>Schließen Sie das andere Programm, das die Kamera verwendet.</translation>
    </message>
    <message>
        <source>Close the other program, then try again.</source>
        <translation>Schließen Sie das andere Programm, und versuchen Sie es dann noch einmal.</translation>
    </message>
    <message>
        <source>Data folder</source>
        <translation>Datenordner</translation>
    </message>
    <message>
        <source>Depth and colour are not aligned at the {markers} ({value} {unit}, up to {limit} is good).</source>
        <translation>Tiefe und Farbe sind hier nicht deckungsgleich: {markers} ({value} {unit}, bis {limit} ist gut).</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Speicherplatz</translation>
    </message>
    <message>
        <source>Driver</source>
        <translation>Treiber</translation>
    </message>
    <message>
        <source>Firmware</source>
        <translation>Firmware</translation>
    </message>
    <message>
        <source>Fist, hook, spread</source>
        <translation>Faust, Haken, Spreizen</translation>
    </message>
    <message>
        <source>Fonts</source>
        <translation>Schriften</translation>
    </message>
    <message>
        <source>Free space on the disk of {folder}.</source>
        <translation>Schaffen Sie Platz auf dem Datenträger von {folder}.</translation>
    </message>
    <message>
        <source>Allow writing there, or choose another folder in the settings.</source>
        <translation>Erlauben Sie dort das Schreiben, oder wählen Sie in den Einstellungen einen anderen Ordner.</translation>
    </message>
    <message>
        <source>Install Carpus again: part of it is missing.</source>
        <translation>Installieren Sie Carpus neu: Ein Teil fehlt.</translation>
    </message>
    <message>
        <source>Install OpenNI2 from the camera’s manufacturer, then restart Carpus.</source>
        <translation>Installieren Sie OpenNI2 vom Hersteller der Kamera, und starten Sie Carpus neu.</translation>
    </message>
    <message>
        <source>Install the package {package}, which is next to the Carpus package.</source>
        <translation>Installieren Sie das Paket {package}, das neben dem Paket von Carpus liegt.</translation>
    </message>
    <message>
        <source>Install the packages that contain these libraries.</source>
        <translation>Installieren Sie die Pakete mit diesen Bibliotheken.</translation>
    </message>
    <message>
        <source>Keep the hand still and take the first image again.</source>
        <translation>Halten Sie die Hand ruhig, und nehmen Sie das erste Bild neu auf.</translation>
    </message>
    <message>
        <source>Keep the hand still for half a second.</source>
        <translation>Halten Sie die Hand eine halbe Sekunde ruhig.</translation>
    </message>
    <message>
        <source>Check the lines on the image, and give the marker its correct label.</source>
        <translation>Prüfen Sie die Linien im Bild, und geben Sie dem Marker die richtige Bezeichnung.</translation>
    </message>
    <message>
        <source>Mirror</source>
        <translation>Spiegelung</translation>
    </message>
    <message>
        <source>Move the hand a little, and keep sunlight and reflections off the marker.</source>
        <translation>Bewegen Sie die Hand ein wenig, und halten Sie Sonnenlicht und Reflexe vom Marker fern.</translation>
    </message>
    <message>
        <source>Needed for live cameras. {remedy}</source>
        <translation>Nötig für die Live-Messung mit Kameras. {remedy}</translation>
    </message>
    <message>
        <source>No blue marker at the {markers}.</source>
        <translation>Kein blauer Marker: {markers}.</translation>
    </message>
    <message>
        <source>Not all files could be deleted yet ({detail} left, such as {subject}).</source>
        <translation>Noch nicht alle Dateien konnten gelöscht werden ({detail} übrig, zum Beispiel {subject}).</translation>
    </message>
    <message>
        <source>OpenNI2</source>
        <translation>OpenNI2</translation>
    </message>
    <message>
        <source>OpenNI2 stops when its version is queried</source>
        <translation>OpenNI2 bricht bei der Abfrage seiner Version ab</translation>
    </message>
    <message>
        <source>OpenNI2 {value}</source>
        <translation>OpenNI2 {value}</translation>
    </message>
    <message>
        <source>Others on this computer can read it. In its properties, remove all rights of the group and of others, or run: chmod 700 &apos;{folder}&apos;</source>
        <translation>Andere an diesem Computer können diesen Ordner lesen. Öffnen Sie seine Eigenschaften, und nehmen Sie „Gruppe“ und „Andere“ alle Rechte. Oder führen Sie aus: chmod 700 &apos;{folder}&apos;</translation>
    </message>
    <message>
        <source>Packages</source>
        <translation>Pakete</translation>
    </message>
    <message>
        <source>Plug in the camera named in the settings, or change the settings.</source>
        <translation>Schließen Sie die in den Einstellungen genannte Kamera an, oder ändern Sie die Einstellungen.</translation>
    </message>
    <message>
        <source>Plug the camera in again, into another port, without a hub.</source>
        <translation>Schließen Sie die Kamera neu an, an einem anderen Anschluss, ohne Hub.</translation>
    </message>
    <message>
        <source>Plug the camera in again. If this persists, times and speeds of this camera are not reliable.</source>
        <translation>Schließen Sie die Kamera neu an. Bleibt der Fehler bestehen, sind Zeiten und Geschwindigkeiten dieser Kamera nicht verlässlich.</translation>
    </message>
    <message>
        <source>Plug the camera in.</source>
        <translation>Schließen Sie die Kamera an.</translation>
    </message>
    <message>
        <source>Python</source>
        <translation>Python</translation>
    </message>
    <message>
        <source>Qt {qt}, which stops the program on Python 3.11</source>
        <translation>Qt {qt}, das mit Python 3.11 das Programm zum Absturz bringt</translation>
    </message>
    <message>
        <source>Qt {qt}; no screen</source>
        <translation>Qt {qt}; kein Bildschirm</translation>
    </message>
    <message>
        <source>Run “{command}”.</source>
        <translation>Führen Sie „{command}“ aus.</translation>
    </message>
    <message>
        <source>Run: installer/setup.sh run. Or: install the packages that contain these libraries.</source>
        <translation>Ausführen: installer/setup.sh run. Oder: Installieren Sie die Pakete mit diesen Bibliotheken.</translation>
    </message>
    <message>
        <source>Run: sudo apt-get install libopenni2-0</source>
        <translation>Ausführen: sudo apt-get install libopenni2-0</translation>
    </message>
    <message>
        <source>Swap the two labels, or click both markers again.</source>
        <translation>Tauschen Sie die beiden Bezeichnungen, oder klicken Sie beide Marker neu an.</translation>
    </message>
    <message>
        <source>Turn on depth registration in the camera settings, or track without depth.</source>
        <translation>Schalten Sie die Ausrichtung von Tiefe und Farbe in den Kameraeinstellungen ein, oder werten Sie ohne Tiefe aus.</translation>
    </message>
    <message>
        <source>Choose the spot with the question mark, if it is the marker.</source>
        <translation>Wählen Sie die Stelle mit dem Fragezeichen, wenn sie der Marker ist.</translation>
    </message>
    <message>
        <source>The PIN cannot be checked: {subject} is missing on this computer ({detail}).</source>
        <translation>Die PIN kann nicht geprüft werden: {subject} fehlt auf diesem Computer ({detail}).</translation>
    </message>
    <message>
        <source>1. Print both pages at 100 % on plain white paper. Check the rulers: 100 mm.</source>
        <translation>1. Beide Seiten mit 100 % auf weißes Papier drucken. Lineale prüfen: 100 mm.</translation>
    </message>
    <message>
        <source>2. Glue this page flat on stiff card. Fold the wedge and glue it onto the dashed field.</source>
        <translation>2. Diese Seite flach auf Karton kleben. Keil falten, auf das gestrichelte Feld kleben.</translation>
    </message>
    <message>
        <source>3. Lay it flat under the camera, about 60 cm away, and run the check for 30 seconds.</source>
        <translation>3. Flach unter die Kamera legen, etwa 60 cm entfernt, und 30 Sekunden lang prüfen.</translation>
    </message>
    <message>
        <source>As root, write into {file}: {rule}. Run: udevadm control --reload. Then plug the camera in again.</source>
        <translation>Als root in {file} schreiben: {rule}. Ausführen: udevadm control --reload. Dann die Kamera neu anschließen.</translation>
    </message>
    <message>
        <source>Carpus camera board: {name}. Glue it flat on a stiff board. Squares: {square}.</source>
        <translation>Kalibriertafel für Carpus: {name}. Flach auf eine steife Platte kleben. Felder: {square}.</translation>
    </message>
    <message>
        <source>Carpus check card</source>
        <translation>Prüfkarte für Carpus</translation>
    </message>
    <message>
        <source>Install Carpus again.</source>
        <translation>Carpus neu installieren.</translation>
    </message>
    <message>
        <source>Orbbec driver</source>
        <translation>Orbbec-Treiber</translation>
    </message>
    <message>
        <source>Plug it into a USB 3 port, with a USB 3 cable and without a hub.</source>
        <translation>Schließen Sie die Kamera an einen USB-3-Anschluss an, mit USB-3-Kabel und ohne Hub.</translation>
    </message>
    <message>
        <source>Plug the camera in, preferably directly into the computer. {port}</source>
        <translation>Schließen Sie die Kamera an, am besten direkt am Computer. {port}</translation>
    </message>
    <message>
        <source>RealSense driver</source>
        <translation>RealSense-Treiber</translation>
    </message>
    <message>
        <source>Camera out of tolerance: {what} (limits: {most_angle}°, {most_length} mm, all lengths {most_share} %).</source>
        <translation>Kamera außerhalb der Toleranz: {what} (Grenzen: {most_angle}°, {most_length} mm, alle Längen {most_share} %).</translation>
    </message>
    <message>
        <source>The clicks for the {markers} are on one marker.</source>
        <translation>Diese Klicks liegen auf einem einzigen Marker: {markers}.</translation>
    </message>
    <message>
        <source>The corners do not fit a flat board: {subject} ({detail}).</source>
        <translation>Die Ecken passen nicht zu einer ebenen Tafel: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The file was not changed.</source>
        <translation>Die Datei wurde nicht verändert.</translation>
    </message>
    <message>
        <source>The hand is tilted {value}° to the camera (up to {limit}° is good).</source>
        <translation>Die Hand ist um {value}° zur Kamera geneigt (bis {limit}° ist gut).</translation>
    </message>
    <message>
        <source>The hand is {value} m from the camera ({limit} m or more is good).</source>
        <translation>Die Hand ist {value} m von der Kamera entfernt ({limit} m oder mehr ist gut).</translation>
    </message>
    <message>
        <source>The hand moved in the first half second.</source>
        <translation>Die Hand bewegte sich in der ersten halben Sekunde.</translation>
    </message>
    <message>
        <source>The {markers} marker is {value} mm from its expected position (up to {limit} mm is good).</source>
        <translation>{markers}: Der Marker liegt {value} mm neben der erwarteten Position (bis {limit} mm ist gut).</translation>
    </message>
    <message>
        <source>The markers of this session cannot be corrected: {subject} ({detail}).</source>
        <translation>Die Marker dieser Sitzung können nicht korrigiert werden: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The recording cannot be read: {subject} ({detail}).</source>
        <translation>Die Aufnahme kann nicht gelesen werden: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The recording has no usable depth: {subject} ({detail}).</source>
        <translation>Die Aufnahme hat keine brauchbare Tiefe: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The recording is damaged: {subject} ({detail}).</source>
        <translation>Die Aufnahme ist beschädigt: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The recording was not changed.</source>
        <translation>Die Aufnahme wurde nicht verändert.</translation>
    </message>
    <message>
        <source>The reference cannot be read: {subject} ({detail}).</source>
        <translation>Die Referenz kann nicht gelesen werden: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The {markers} does not lie on the line of its finger.</source>
        <translation>{markers}: Der Marker liegt nicht auf der Linie seines Fingers.</translation>
    </message>
    <message>
        <source>There is no folder {subject}.</source>
        <translation>Es gibt keinen Ordner {subject}.</translation>
    </message>
    <message>
        <source>There is one more blue spot on the hand than there are labels.</source>
        <translation>Auf der Hand ist eine blaue Stelle mehr, als es Bezeichnungen gibt.</translation>
    </message>
    <message>
        <source>This looks like the other hand.</source>
        <translation>Das sieht nach der anderen Hand aus.</translation>
    </message>
    <message>
        <source>This port is slow for this camera. {port}</source>
        <translation>Dieser Anschluss ist für diese Kamera zu langsam. {port}</translation>
    </message>
    <message>
        <source>This port is too slow. {port}</source>
        <translation>Dieser Anschluss ist zu langsam. {port}</translation>
    </message>
    <message>
        <source>This session is not finished: {subject}.</source>
        <translation>Diese Sitzung ist nicht abgeschlossen: {subject}.</translation>
    </message>
    <message>
        <source>Turn the back of the hand to the camera.</source>
        <translation>Drehen Sie den Handrücken zur Kamera.</translation>
    </message>
    <message>
        <source>Use another USB port, without a hub or other cameras. Close other demanding programs.</source>
        <translation>Nehmen Sie einen anderen USB-Anschluss, ohne Hub und ohne andere Kameras. Schließen Sie andere rechenintensive Programme.</translation>
    </message>
    <message>
        <source>Wedge: cut along the lines, fold back along the dashes</source>
        <translation>Keil: an den Linien schneiden, an den gestrichelten nach hinten falten</translation>
    </message>
    <message>
        <source>Window</source>
        <translation>Fenster</translation>
    </message>
    <message>
        <source>Wrist, all movements</source>
        <translation>Handgelenk, alle Bewegungen</translation>
    </message>
    <message>
        <source>a folder</source>
        <translation>ein Ordner</translation>
    </message>
    <message>
        <source>a marker was placed outside the image</source>
        <translation>ein Marker liegt außerhalb des Bildes</translation>
    </message>
    <message>
        <source>a text with an invalid character, in {file}</source>
        <translation>ein Text mit einem ungültigen Zeichen, in {file}</translation>
    </message>
    <message>
        <source>an HDF5 file, but not a session</source>
        <translation>eine HDF5-Datei, aber keine Sitzung</translation>
    </message>
    <message>
        <source>another computer is sending its data</source>
        <translation>ein anderer Computer sendet gerade seine Daten</translation>
    </message>
    <message>
        <source>camera_matrix has {count} numbers, 9 expected</source>
        <translation>camera_matrix hat {count} Zahlen, erwartet sind 9</translation>
    </message>
    <message>
        <source>camera_matrix is not [fx, 0, cx, 0, fy, cy, 0, 0, 1]</source>
        <translation>camera_matrix ist nicht [fx, 0, cx, 0, fy, cy, 0, 0, 1]</translation>
    </message>
    <message>
        <source>cannot be opened</source>
        <translation>lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>chessboard {columns} x {rows}, squares of {size} mm</source>
        <translation>Schachbrett {columns} x {rows}, Felder von {size} mm</translation>
    </message>
    <message>
        <source>codec {codec} for {name}</source>
        <translation>Codec {codec} für {name}</translation>
    </message>
    <message>
        <source>colour as {name}</source>
        <translation>Farbe als {name}</translation>
    </message>
    <message>
        <source>colour frame {row}</source>
        <translation>Farbbild {row}</translation>
    </message>
    <message>
        <source>columns</source>
        <translation>Spalten</translation>
    </message>
    <message>
        <source>reprojection error {error_px} px, at most {most_px} px accepted</source>
        <translation>Reprojektionsfehler {error_px} px, höchstens {most_px} px zulässig</translation>
    </message>
    <message>
        <source>cropped frames</source>
        <translation>beschnittene Bilder</translation>
    </message>
    <message>
        <source>truncated or altered</source>
        <translation>abgeschnitten oder verändert</translation>
    </message>
    <message>
        <source>damaged</source>
        <translation>beschädigt</translation>
    </message>
    <message>
        <source>damaged, or not C3D</source>
        <translation>beschädigt oder kein C3D</translation>
    </message>
    <message>
        <source>damaged: depth sensor, {cause}</source>
        <translation>beschädigt: Tiefensensor, {cause}</translation>
    </message>
    <message>
        <source>damaged: its content is implausible</source>
        <translation>beschädigt: unplausibler Inhalt</translation>
    </message>
    <message>
        <source>damaged: {value}</source>
        <translation>beschädigt: {value}</translation>
    </message>
    <message>
        <source>depth as {name}</source>
        <translation>Tiefe als {name}</translation>
    </message>
    <message>
        <source>depth and colour are not aligned</source>
        <translation>Tiefe und Farbe sind nicht deckungsgleich</translation>
    </message>
    <message>
        <source>depth and colour are aligned, {registered}</source>
        <translation>Tiefe und Farbe sind deckungsgleich, {registered}</translation>
    </message>
    <message>
        <source>distortion {model} with {count} coefficients</source>
        <translation>Verzeichnung {model} mit {count} Koeffizienten</translation>
    </message>
    <message>
        <source>distortion_coefficients has {count} numbers, {wanted} expected</source>
        <translation>distortion_coefficients hat {count} Zahlen, erwartet sind {wanted}</translation>
    </message>
    <message>
        <source>distortion_model {said}, {coefficients} expected</source>
        <translation>distortion_model {said}, erwartet ist {coefficients}</translation>
    </message>
    <message>
        <source>empty file</source>
        <translation>leere Datei</translation>
    </message>
    <message>
        <source>foot: glue onto the card</source>
        <translation>Fuß: auf die Karte kleben</translation>
    </message>
    <message>
        <source>for {width_px} x {height_px} pixels, the frames have {size}</source>
        <translation>für {width_px} x {height_px} Pixel, die Bilder haben {size}</translation>
    </message>
    <message>
        <source>over weeks, compared with the measurement error (MDC95)</source>
        <translation>über Wochen, verglichen mit dem Messfehler (MDC95)</translation>
    </message>
    <message>
        <source>fx {fx} and fy {fy} do not fit a frame width of {width} pixels</source>
        <translation>fx {fx} und fy {fy} passen nicht zu {width} Pixel breiten Bildern</translation>
    </message>
    <message>
        <source>glue under the low edge</source>
        <translation>unter die untere Kante kleben</translation>
    </message>
    <message>
        <source>goniometer list</source>
        <translation>Goniometer-Liste</translation>
    </message>
    <message>
        <source>hand</source>
        <translation>Hand</translation>
    </message>
    <message>
        <source>hand {hand}</source>
        <translation>Hand {hand}</translation>
    </message>
    <message>
        <source>in none of the images</source>
        <translation>in keinem der Bilder</translation>
    </message>
    <message>
        <source>inside the data folder, or containing it</source>
        <translation>liegt im Datenordner oder enthält ihn</translation>
    </message>
    <message>
        <source>index finger</source>
        <translation>Zeigefinger</translation>
    </message>
    <message>
        <source>index DIP</source>
        <translation>Zeigefinger-DIP</translation>
    </message>
    <message>
        <source>index PIP</source>
        <translation>Zeigefinger-PIP</translation>
    </message>
    <message>
        <source>index MCP</source>
        <translation>Zeigefinger-MCP</translation>
    </message>
    <message>
        <source>index fingertip</source>
        <translation>Zeigefingerspitze</translation>
    </message>
    <message>
        <source>not readable as JSON, so the default limits apply</source>
        <translation>nicht als JSON lesbar; es gelten die Standardgrenzen</translation>
    </message>
    <message>
        <source>no frames</source>
        <translation>keine Bilder</translation>
    </message>
    <message>
        <source>no points</source>
        <translation>keine Punkte</translation>
    </message>
    <message>
        <source>no points, or no rate stated</source>
        <translation>keine Punkte, oder keine Rate angegeben</translation>
    </message>
    <message>
        <source>no readings</source>
        <translation>keine Messwerte</translation>
    </message>
    <message>
        <source>no table</source>
        <translation>keine Tabelle</translation>
    </message>
    <message>
        <source>columns do not match their names</source>
        <translation>Spalten passen nicht zu ihren Namen</translation>
    </message>
    <message>
        <source>times out of order</source>
        <translation>Zeiten nicht aufsteigend</translation>
    </message>
    <message>
        <source>times span more than a day: damaged, or a clock jumped</source>
        <translation>Zeiten umfassen mehr als einen Tag: beschädigt, oder die Uhr ist gesprungen</translation>
    </message>
    <message>
        <source>unit {unit}</source>
        <translation>Einheit {unit}</translation>
    </message>
    <message>
        <source>larger than 1 GB</source>
        <translation>größer als 1 GB</translation>
    </message>
    <message>
        <source>larger than 2 GB</source>
        <translation>größer als 2 GB</translation>
    </message>
    <message>
        <source>line {number} is not a time and a file name: {content}</source>
        <translation>Zeile {number} enthält nicht Zeit und Dateiname: {content}</translation>
    </message>
    <message>
        <source>line {number}: {time_s} s after {earlier} s</source>
        <translation>Zeile {number}: {time_s} s nach {earlier} s</translation>
    </message>
    <message>
        <source>little finger</source>
        <translation>Kleinfinger</translation>
    </message>
    <message>
        <source>little finger DIP</source>
        <translation>Kleinfinger-DIP</translation>
    </message>
    <message>
        <source>little finger PIP</source>
        <translation>Kleinfinger-PIP</translation>
    </message>
    <message>
        <source>little finger MCP</source>
        <translation>Kleinfinger-MCP</translation>
    </message>
    <message>
        <source>little fingertip</source>
        <translation>Kleinfingerspitze</translation>
    </message>
    <message>
        <source>unknown processor type {processor}</source>
        <translation>unbekannter Prozessortyp {processor}</translation>
    </message>
    <message>
        <source>markers</source>
        <translation>Marker</translation>
    </message>
    <message>
        <source>middle finger</source>
        <translation>Mittelfinger</translation>
    </message>
    <message>
        <source>middle finger DIP</source>
        <translation>Mittelfinger-DIP</translation>
    </message>
    <message>
        <source>middle finger PIP</source>
        <translation>Mittelfinger-PIP</translation>
    </message>
    <message>
        <source>middle finger MCP</source>
        <translation>Mittelfinger-MCP</translation>
    </message>
    <message>
        <source>middle fingertip</source>
        <translation>Mittelfingerspitze</translation>
    </message>
    <message>
        <source>missing, and there is no default camera for frames of {size}</source>
        <translation>fehlt, und für Bilder mit {size} gibt es keine Standardkamera</translation>
    </message>
    <message>
        <source>missing, {place}</source>
        <translation>fehlt, {place}</translation>
    </message>
    <message>
        <source>missing: {name}</source>
        <translation>fehlt: {name}</translation>
    </message>
    <message>
        <source>missing: {package}</source>
        <translation>fehlt: {package}</translation>
    </message>
    <message>
        <source>more than one camera</source>
        <translation>mehr als eine Kamera</translation>
    </message>
    <message>
        <source>too long for a camera calibration</source>
        <translation>zu lang für eine Kamerakalibrierung</translation>
    </message>
    <message>
        <source>too long for a file of clicks</source>
        <translation>zu lang für eine Datei mit Klicks</translation>
    </message>
    <message>
        <source>not MOT: the header has no end</source>
        <translation>kein MOT: Der Kopf hat kein Ende</translation>
    </message>
    <message>
        <source>no answer for {patience_s} s</source>
        <translation>keine Antwort seit {patience_s} s</translation>
    </message>
    <message>
        <source>no attribute {name}</source>
        <translation>kein Attribut {name}</translation>
    </message>
    <message>
        <source>no colour frames</source>
        <translation>keine Farbbilder</translation>
    </message>
    <message>
        <source>no dataset {path}</source>
        <translation>kein Datensatz {path}</translation>
    </message>
    <message>
        <source>no depth frame within {pairing_limit_s} ms of a colour frame</source>
        <translation>kein Tiefenbild innerhalb von {pairing_limit_s} ms um ein Farbbild</translation>
    </message>
    <message>
        <source>no intrinsics for frames of {size}</source>
        <translation>keine Kameraparameter für Bilder mit {size}</translation>
    </message>
    <message>
        <source>no markers</source>
        <translation>keine Marker</translation>
    </message>
    <message>
        <source>no frame in {color_list}</source>
        <translation>kein Bild in {color_list}</translation>
    </message>
    <message>
        <source>no frame in {depth_list}</source>
        <translation>kein Bild in {depth_list}</translation>
    </message>
    <message>
        <source>no usable reading</source>
        <translation>keine verwendbare Ablesung</translation>
    </message>
    <message>
        <source>no space for another {length} MB</source>
        <translation>kein Platz für weitere {length} MB</translation>
    </message>
    <message>
        <source>no udev rules for the camera</source>
        <translation>keine udev-Regeln für die Kamera</translation>
    </message>
    <message>
        <source>none plugged in</source>
        <translation>keine angeschlossen</translation>
    </message>
    <message>
        <source>not JSON</source>
        <translation>kein JSON</translation>
    </message>
    <message>
        <source>not JSON, line {lineno}</source>
        <translation>kein JSON, Zeile {lineno}</translation>
    </message>
    <message>
        <source>not YAML</source>
        <translation>kein YAML</translation>
    </message>
    <message>
        <source>not a backup</source>
        <translation>keine Sicherung</translation>
    </message>
    <message>
        <source>not a camera calibration</source>
        <translation>keine Kamerakalibrierung</translation>
    </message>
    <message>
        <source>not a folder</source>
        <translation>kein Ordner</translation>
    </message>
    <message>
        <source>not an image</source>
        <translation>kein Bild</translation>
    </message>
    <message>
        <source>not a raw recording</source>
        <translation>keine Rohaufnahme</translation>
    </message>
    <message>
        <source>not a session file</source>
        <translation>keine Sitzungsdatei</translation>
    </message>
    <message>
        <source>not a text file</source>
        <translation>keine Textdatei</translation>
    </message>
    <message>
        <source>not an .oni file</source>
        <translation>keine .oni-Datei</translation>
    </message>
    <message>
        <source>not an object with hand, protocol and markers</source>
        <translation>kein Objekt mit hand, protocol und markers</translation>
    </message>
    <message>
        <source>excluded from the group values: {people}, fewer than {fewest} pairs</source>
        <translation>nicht in den Gruppenwerten: {people}, weniger als {fewest} Paare</translation>
    </message>
    <message>
        <source>not in the patient list</source>
        <translation>nicht in der Patientenliste</translation>
    </message>
    <message>
        <source>not the part file of a session</source>
        <translation>nicht die Teildatei einer Sitzung</translation>
    </message>
    <message>
        <source>off</source>
        <translation>aus</translation>
    </message>
    <message>
        <source>paths outside the folder</source>
        <translation>Pfade außerhalb des Ordners</translation>
    </message>
    <message>
        <source>print again at 100 % (“actual size”).</source>
        <translation>neu drucken mit 100 % („Originalgröße“).</translation>
    </message>
    <message>
        <source>ring finger</source>
        <translation>Ringfinger</translation>
    </message>
    <message>
        <source>ring finger DIP</source>
        <translation>Ringfinger-DIP</translation>
    </message>
    <message>
        <source>ring finger PIP</source>
        <translation>Ringfinger-PIP</translation>
    </message>
    <message>
        <source>ring finger MCP</source>
        <translation>Ringfinger-MCP</translation>
    </message>
    <message>
        <source>ring fingertip</source>
        <translation>Ringfingerspitze</translation>
    </message>
    <message>
        <source>rows of different length, or not numbers</source>
        <translation>Zeilen verschiedener Länge, oder keine Zahlen</translation>
    </message>
    <message>
        <source>still being recorded</source>
        <translation>wird noch aufgenommen</translation>
    </message>
    <message>
        <source>the curves are opposite, or the time shift is more than {most} s</source>
        <translation>die Kurven sind gegenläufig, oder der Zeitversatz ist größer als {most} s</translation>
    </message>
    <message>
        <source>the curves are opposite, or the time shift is more than {most} s. With the same sign they match best at {later} s ({match})</source>
        <translation>die Kurven sind gegenläufig, oder der Zeitversatz ist größer als {most} s. Mit gleichem Vorzeichen passen sie am besten zusammen bei {later} s ({match})</translation>
    </message>
    <message>
        <source>the file changes while it is read</source>
        <translation>die Datei ändert sich, während sie gelesen wird</translation>
    </message>
    <message>
        <source>the session contains no frames</source>
        <translation>die Sitzung enthält kein Bild</translation>
    </message>
    <message>
        <source>file not found</source>
        <translation>Datei nicht gefunden</translation>
    </message>
    <message>
        <source>to CSV, JSON, C3D, TRC, MOT and BIDS</source>
        <translation>in CSV, JSON, C3D, TRC, MOT und BIDS</translation>
    </message>
    <message>
        <source>{angle} at {time} s: the hand was not still, or not visible</source>
        <translation>{angle} bei {time} s: Die Hand war nicht ruhig oder nicht sichtbar</translation>
    </message>
    <message>
        <source>{angle}: not in the session</source>
        <translation>{angle}: nicht in der Sitzung</translation>
    </message>
    <message>
        <source>{count} faces</source>
        <translation>{count} Schnitte</translation>
    </message>
    <message>
        <source>{count} frames</source>
        <translation>{count} Bilder</translation>
    </message>
    <message>
        <source>{firmware}, the library asks for {wanted}</source>
        <translation>{firmware}, die Bibliothek verlangt {wanted}</translation>
    </message>
    <message>
        <source>{found}, cannot be loaded: {trouble}</source>
        <translation>{found}, lässt sich nicht laden: {trouble}</translation>
    </message>
    <message>
        <source>{free} GB free, about {minutes} minutes with video</source>
        <translation>{free} GB frei, etwa {minutes} Minuten mit Video</translation>
    </message>
    <message>
        <source>{names}</source>
        <translation>{names}</translation>
    </message>
    <message>
        <source>{names} and {count} more</source>
        <translation>{names} und {count} weitere</translation>
    </message>
    <message>
        <source>{name} ({vendor}:{product}) at {node}, {speed_mbit} Mbit/s</source>
        <translation>{name} ({vendor}:{product}) an {node}, {speed_mbit} Mbit/s</translation>
    </message>
    <message>
        <source>{remedy} In a dark room the camera slows down: add light.</source>
        <translation>{remedy} In einem dunklen Raum wird die Kamera langsamer: mehr Licht.</translation>
    </message>
    <message>
        <source>{text}, in use</source>
        <translation>{text}, in Gebrauch</translation>
    </message>
    <message>
        <source>{what} {names}: {why}</source>
        <translation>{what} {names}: {why}</translation>
    </message>
    <message>
        <source>{width}x{height}, {fps} fps, {missing} missing, depth in {with_depth} of {count}</source>
        <translation>{width}x{height}, {fps} fps, {missing} fehlen, Tiefe in {with_depth} von {count}</translation>
    </message>
    <message>
        <source>± is the SD between repetitions.</source>
        <translation>± ist die SD zwischen den Wiederholungen.</translation>
    </message>
    <message>
        <source>thumb</source>
        <translation>Daumen</translation>
    </message>
    <message>
        <source>thumb CMC</source>
        <translation>Daumen-CMC</translation>
    </message>
    <message>
        <source>thumb IP</source>
        <translation>Daumen-IP</translation>
    </message>
    <message>
        <source>thumb MCP</source>
        <translation>Daumen-MCP</translation>
    </message>
    <message>
        <source>thumb tip</source>
        <translation>Daumenspitze</translation>
    </message>
    <message>
        <source>wrist</source>
        <translation>Handgelenk</translation>
    </message>
    <message>
        <source>{angle}: the reference moves {percent} % as far as Carpus. It may have another unit or be another angle</source>
        <translation>{angle}: Die Referenz zeigt {percent} % der Bewegung, die Carpus misst. Vielleicht hat sie eine andere Einheit oder gibt einen anderen Winkel an</translation>
    </message>
    <message>
        <source>{calibration} has an impossible depth</source>
        <translation>{calibration} hat eine unmögliche Tiefe</translation>
    </message>
    <message>
        <source>{calibration} is not in the format of Carpus</source>
        <translation>{calibration} hat nicht das Format von Carpus</translation>
    </message>
    <message>
        <source>{cause} appears twice</source>
        <translation>{cause} kommt zweimal vor</translation>
    </message>
    <message>
        <source>{count} files</source>
        <translation>{count} Dateien</translation>
    </message>
    <message>
        <source>{detail}; {count} rows read</source>
        <translation>{detail}; {count} Zeilen gelesen</translation>
    </message>
    <message>
        <source>{free} MB free, {least_free_bytes} MB are needed</source>
        <translation>{free} MB frei, {least_free_bytes} MB werden gebraucht</translation>
    </message>
    <message>
        <source>{key} has no data</source>
        <translation>{key} hat keine Daten</translation>
    </message>
    <message>
        <source>{key} contains a value that is not a number</source>
        <translation>{key} enthält einen Wert, der keine Zahl ist</translation>
    </message>
    <message>
        <source>{key} is neither true nor false</source>
        <translation>{key} ist weder true noch false</translation>
    </message>
    <message>
        <source>{key} is not a number of pixels</source>
        <translation>{key} ist keine Pixelzahl</translation>
    </message>
    <message>
        <source>{lost} of {count} frames</source>
        <translation>{lost} von {count} Bildern</translation>
    </message>
    <message>
        <source>{name} changes within the file</source>
        <translation>{name} ändert sich innerhalb der Datei</translation>
    </message>
    <message>
        <source>{np} frames missing</source>
        <translation>{np} Bilder fehlen</translation>
    </message>
    <message>
        <source>{one} and {other}</source>
        <translation>{one} und {other}</translation>
    </message>
    <message>
        <source>{one}; {other}</source>
        <translation>{one}; {other}</translation>
    </message>
    <message>
        <source>{shape} x {shape2} pixels, {width} x {height} before</source>
        <translation>{shape} x {shape2} Pixel, vorher {width} x {height}</translation>
    </message>
    <message>
        <source>{timestamp_s} s after {last_time_s} s</source>
        <translation>{timestamp_s} s nach {last_time_s} s</translation>
    </message>
    <message>
        <source>{u}, {v} in a frame of {width_px} x {height_px} pixels</source>
        <translation>{u}, {v} in einem Bild mit {width_px} x {height_px} Pixeln</translation>
    </message>
    <message>
        <source>{value} is not a possible number, in {file}</source>
        <translation>{value} ist kein zulässiger Wert (in {file})</translation>
    </message>
    <message>
        <source>{value} frame {number}</source>
        <translation>{value}, Bild {number}</translation>
    </message>
    <message>
        <source>{what}, at byte {position}</source>
        <translation>{what}, bei Byte {position}</translation>
    </message>
    <message>
        <source>Re&amp;view it</source>
        <translation>Zur Aus&amp;wertung</translation>
    </message>
    <message>
        <source>I have read it</source>
        <translation>Ich habe es gelesen</translation>
    </message>
    <message>
        <source>words that lose their capital inside a sentence: *</source>
        <translation>Wörter, die im Satz klein werden: Rechte Linke Beide Rechts Links Radial Ulnar Nie Noch Kalibriert Geprüft Gerade Gestreckt Gebeugt Beugen Heben Schieben Drehen Schließen Spreizen Öffnen Nehmen Bewegen Strecken Kommen Berühren Runter Hoch Zum Zur Nach</translation>
    </message>
    <message>
        <source>page {number} of {count}</source>
        <translation>Seite {number} von {count}</translation>
    </message>
    <message>
        <source>Flexion {flexion}, extension {extension}.</source>
        <translation>Flexion {flexion}, Extension {extension}.</translation>
    </message>
    <message>
        <source>The total arc is {arc}. {change}</source>
        <translation>Das Gesamtausmaß ist {arc}. {change}</translation>
    </message>
    <message>
        <source>Splint as before; exercises at home three times a day.</source>
        <translation>Schiene wie bisher; dreimal täglich zu Hause üben.</translation>
    </message>
    <message>
        <source>Reassess in two weeks.</source>
        <translation>In zwei Wochen erneut untersuchen.</translation>
    </message>
    <message>
        <source>Practice patient</source>
        <translation>Testpatient</translation>
    </message>
    <message>
        <source>There is no session in {subject}.</source>
        <translation>In {subject} gibt es keine Sitzung.</translation>
    </message>
    <message>
        <source>did you mean “{meant}”? There are: {names}</source>
        <translation>meinten Sie „{meant}“? Es gibt: {names}</translation>
    </message>
    <message>
        <source>distortion_coefficients do not describe a lens: they cannot be inverted</source>
        <translation>distortion_coefficients beschreiben kein Objektiv: sie sind nicht umkehrbar</translation>
    </message>
    <message>
        <source>damaged header, {count} frames present</source>
        <translation>beschädigter Kopf, {count} Bilder vorhanden</translation>
    </message>
    <message>
        <source>there are none yet</source>
        <translation>es gibt noch keine</translation>
    </message>
    <message>
        <source>there are: {names}</source>
        <translation>es gibt: {names}</translation>
    </message>
    <message>
        <source>Ask your IT support. {how}</source>
        <translation>Fragen Sie Ihre IT-Betreuung. {how}</translation>
    </message>
    <message>
        <source>Disk encryption</source>
        <translation>Verschlüsselung des Datenträgers</translation>
    </message>
    <message>
        <source>Linux encrypts a disk when it is set up (LUKS). Choose this when the system is installed, or move the data folder to an encrypted disk. Do not keep the passphrase with this computer.</source>
        <translation>Linux verschlüsselt einen Datenträger beim Einrichten (LUKS). Wählen Sie das bei der Installation des Systems, oder legen Sie den Datenordner auf einen verschlüsselten Datenträger. Bewahren Sie die Passphrase nicht an diesem Computer auf.</translation>
    </message>
    <message>
        <source>Turn it on in Windows: Settings → Privacy and security → Device encryption, or BitLocker in the Control Panel. Do not keep the recovery key with this computer.</source>
        <translation>In Windows einschalten: Einstellungen → Datenschutz und Sicherheit → Geräteverschlüsselung, oder BitLocker in der Systemsteuerung. Bewahren Sie den Wiederherstellungsschlüssel nicht an diesem Computer auf.</translation>
    </message>
    <message>
        <source>The disk of the data folder is encrypted by the system.</source>
        <translation>Der Datenträger des Datenordners ist vom System verschlüsselt.</translation>
    </message>
    <message>
        <source>The disk of the data folder is not encrypted.</source>
        <translation>Der Datenträger des Datenordners ist nicht verschlüsselt.</translation>
    </message>
    <message>
        <source>It is not known whether the disk of the data folder is encrypted.</source>
        <translation>Es ist nicht bekannt, ob der Datenträger des Datenordners verschlüsselt ist.</translation>
    </message>
    <message>
        <source>Labels are correct</source>
        <translation>Ja, sie stimmen</translation>
    </message>
    <message>
        <source>Drag a label to another marker to change it.</source>
        <translation>Zum Ändern eine Bezeichnung auf einen anderen Marker ziehen.</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Messen</translation>
    </message>
    <message>
        <source>Progress</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>Review</source>
        <translation>Auswertung</translation>
    </message>
    <message>
        <source>a session or the progress as a PDF in English, German or Italian</source>
        <translation>eine Sitzung oder der Verlauf als PDF auf Englisch, Deutsch oder Italienisch</translation>
    </message>
    <message>
        <source>wrist and finger angles while the patient moves</source>
        <translation>Winkel von Handgelenk und Fingern während der Bewegung</translation>
    </message>
    <message>
        <source>{count} pairs, {kind}</source>
        <translation>{count} Paare, {kind}</translation>
    </message>
    <message>
        <source>AMA Guides; AAOS 1965 (goniometer)</source>
        <translation>AMA Guides; AAOS 1965 (Goniometer)</translation>
    </message>
    <message>
        <source>ASSH, sum of active flexion in a fist</source>
        <translation>ASSH, Summe der aktiven Flexion in der Faust</translation>
    </message>
    <message>
        <source>The packaged program does not include {packages}. Carpus installed from source can use it.</source>
        <translation>Das Programmpaket enthält {packages} nicht. Ein aus dem Quelltext installiertes Carpus kann es verwenden.</translation>
    </message>
    <message>
        <source>not readable as a table: {why}</source>
        <translation>nicht als Tabelle lesbar: {why}</translation>
    </message>
    <message>
        <source>not chosen yet</source>
        <translation>noch nicht gewählt</translation>
    </message>
    <message>
        <source>not available now</source>
        <translation>zurzeit nicht verfügbar</translation>
    </message>
    <message>
        <source>not connected</source>
        <translation>nicht verbunden</translation>
    </message>
    <message>
        <source>{free} GB free</source>
        <translation>{free} GB frei</translation>
    </message>
    <message>
        <source>on the same disk as the data</source>
        <translation>auf demselben Datenträger wie die Daten</translation>
    </message>
    <message>
        <source>There is no backup yet.</source>
        <translation>Es gibt noch keine Sicherung.</translation>
    </message>
    <message>
        <source>The last backup is {days} days old.</source>
        <translation>Die letzte Sicherung ist {days} Tage alt.</translation>
    </message>
    <message>
        <source>{when} · {n} session files, {size} GB · verified</source>
        <translation>{when} · {n} Sitzungsdateien, {size} GB · geprüft</translation>
    </message>
    <message>
        <source>{when} · 1 session file, {size} GB · verified</source>
        <translation>{when} · 1 Sitzungsdatei, {size} GB · geprüft</translation>
    </message>
    <message>
        <source>Reminder after {days} days.</source>
        <translation>Erinnerung nach {days} Tagen.</translation>
    </message>
    <message>
        <source>only {time} s of overlap: the time shift is uncertain</source>
        <translation>nur {time} s Überschneidung: der Zeitversatz ist unsicher</translation>
    </message>
    <message>
        <source>the curves and camera images, and correct single repetitions</source>
        <translation>Kurven und Bilder ansehen, einzelne Wiederholungen korrigieren</translation>
    </message>
    <message>
        <source>the best time shift is at the limit of the search range: it may be larger</source>
        <translation>der beste Zeitversatz liegt am Rand des Suchbereichs: er kann größer sein</translation>
    </message>
    <message>
        <source>the clocks drift: the reference by {percent} % relative to Carpus, {seconds} s over {length} s. The values contain this error (lag {lag} s with drift {drift} %)</source>
        <translation>die Uhren laufen auseinander: die der Referenz um {percent} % gegenüber Carpus, {seconds} s in {length} s. Die Werte enthalten diesen Fehler (Zeitversatz {lag} s mit Drift {drift} %)</translation>
    </message>
    <message>
        <source>the time shift is uncertain: {taken} s is used ({match}). Equally or nearly as good: {others}</source>
        <translation>der Zeitversatz ist unsicher: verwendet wird {taken} s ({match}). Gleich gut oder fast so gut: {others}</translation>
    </message>
    <message>
        <source>women and men together</source>
        <translation>Frauen und Männer zusammen</translation>
    </message>
    <message>
        <source>{angle}: opposite to Carpus (r = {r}). One of the two has the opposite sign or shows another movement</source>
        <translation>{angle}: entgegengesetzt zu Carpus (r = {r}). Eines von beiden hat das entgegengesetzte Vorzeichen oder zeigt eine andere Bewegung</translation>
    </message>
    <message>
        <source>{people} people are too few for group values: three are needed</source>
        <translation>{people} Personen sind zu wenige für Gruppenwerte: drei sind nötig</translation>
    </message>
    <message>
        <source>{people} people, {sessions} sessions, {kinds}</source>
        <translation>{people} Personen, {sessions} Sitzungen, {kinds}</translation>
    </message>
    <message>
        <source>more than {count} characters</source>
        <translation>mehr als {count} Zeichen</translation>
    </message>
    <message>
        <source>not in the session folder</source>
        <translation>nicht im Sitzungsordner</translation>
    </message>
    <message>
        <source>No change beyond measurement error since {day}.</source>
        <translation>Seit dem {day} keine Änderung über den Messfehler hinaus.</translation>
    </message>
    <message>
        <source>{name}: no change beyond measurement error.</source>
        <translation>{name}: keine Änderung über den Messfehler hinaus.</translation>
    </message>
    <message>
        <source>No change beyond measurement error since {when}.</source>
        <translation>Seit dem {when} keine Änderung über den Messfehler hinaus.</translation>
    </message>
    <message>
        <source>no change beyond MDC</source>
        <translation>keine Änderung über der MDC</translation>
    </message>
    <message>
        <source>{sign} = minimum: the end of this movement was occluded.</source>
        <translation>{sign} = Mindestwert: Das Ende dieser Bewegung war verdeckt.</translation>
    </message>
    <message>
        <source>Active</source>
        <translation>Aktiv</translation>
    </message>
    <message>
        <source>Passive</source>
        <translation>Passiv</translation>
    </message>
    <message>
        <source>Passive minus active</source>
        <translation>Passiv minus aktiv</translation>
    </message>
    <message>
        <source>Finger</source>
        <translation>Finger</translation>
    </message>
    <message>
        <source>within MDC</source>
        <translation>innerhalb der MDC</translation>
    </message>
    <message>
        <source>{gap} (MDC {limit})</source>
        <translation>{gap} (MDC {limit})</translation>
    </message>
    <message>
        <source>{name}: active {active}, passive {passive}. The difference of {gap} is beyond the measurement error.</source>
        <translation>{name}: aktiv {active}, passiv {passive}. Die Differenz von {gap} ist größer als der Messfehler.</translation>
    </message>
    <message>
        <source>Active and passive range are shown without an assessment: {why}.</source>
        <translation>Aktives und passives Bewegungsausmaß ohne Beurteilung: {why}.</translation>
    </message>
    <message>
        <source>You have kept the progress you made.</source>
        <translation>Sie haben Ihren Fortschritt gehalten.</translation>
    </message>
    <message>
        <source>You have reached our goal.</source>
        <translation>Sie haben unser Ziel erreicht.</translation>
    </message>
    <message>
        <source>You are more than halfway to our goal.</source>
        <translation>Sie haben mehr als die Hälfte des Weges zu unserem Ziel geschafft.</translation>
    </message>
    <message>
        <source>You can move further than when you started.</source>
        <translation>Sie kommen weiter als zu Beginn.</translation>
    </message>
    <message>
        <source>once</source>
        <translation>einmal</translation>
    </message>
    <message>
        <source>{count} times</source>
        <translation>{count}-mal</translation>
    </message>
    <message>
        <source>once a day</source>
        <translation>einmal am Tag</translation>
    </message>
    <message>
        <source>{count} times a day</source>
        <translation>{count}-mal am Tag</translation>
    </message>
    <message>
        <source>dashed: at the start; solid: today</source>
        <translation>gestrichelt: am Anfang; durchgezogen: heute</translation>
    </message>
    <message>
        <source>dashed: at the start; solid: today; green: our goal</source>
        <translation>gestrichelt: am Anfang; durchgezogen: heute; grün: unser Ziel</translation>
    </message>
    <message>
        <source>our goal</source>
        <translation>unser Ziel</translation>
    </message>
    <message>
        <source>Next appointment</source>
        <translation>Nächster Termin</translation>
    </message>
    <message>
        <source>The computer is too busy</source>
        <translation>Der Computer ist überlastet</translation>
    </message>
    <message>
        <source>{count} frames are missing: close other programs</source>
        <translation>{count} Bilder fehlen: andere Programme schließen</translation>
    </message>
    <message>
        <source>The computer is busy; every frame is saved</source>
        <translation>Der Computer ist ausgelastet; kein Bild fehlt</translation>
    </message>
    <message>
        <source>Values are {seconds} s behind</source>
        <translation>Werte {seconds} s im Rückstand</translation>
    </message>
    <message>
        <source>The computer is busy</source>
        <translation>Der Computer ist ausgelastet</translation>
    </message>
    <message>
        <source>{time} of {whole}</source>
        <translation>{time} von {whole}</translation>
    </message>
    <message>
        <source>{angle}, passive</source>
        <translation>{angle}, passiv</translation>
    </message>
    <message>
        <source>Simulated hand</source>
        <translation>Simulierte Hand</translation>
    </message>
    <message>
        <source>1 marker occluded</source>
        <translation>1 Marker verdeckt</translation>
    </message>
    <message>
        <source>report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>letter</source>
        <translation>Brief</translation>
    </message>
    <message>
        <source>home</source>
        <translation>Zuhause</translation>
    </message>
    <message>
        <source>progress</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>Repetitions</source>
        <translation>Wiederholungen</translation>
    </message>
    <message>
        <source>Range of motion, fingers</source>
        <translation>Bewegungsausmaß, Finger</translation>
    </message>
    <message>
        <source>Speed and smoothness</source>
        <translation>Geschwindigkeit und Gleichmäßigkeit</translation>
    </message>
    <message>
        <source>Quality of the recording</source>
        <translation>Qualität der Aufnahme</translation>
    </message>
    <message>
        <source>Reaching movements</source>
        <translation>Reichbewegungen</translation>
    </message>
    <message>
        <source>not available: fewer than {count} frames a second</source>
        <translation>nicht verfügbar: weniger als {count} Bilder pro Sekunde</translation>
    </message>
    <message>
        <source>not available: the calculation failed</source>
        <translation>nicht verfügbar: Berechnung fehlgeschlagen</translation>
    </message>
    <message>
        <source>{verdict} Checked {day}.</source>
        <translation>{verdict} Geprüft am {day}.</translation>
    </message>
    <message>
        <source>never calibrated</source>
        <translation>nie kalibriert</translation>
    </message>
    <message>
        <source>calibrated {ago}</source>
        <translation>{ago} kalibriert</translation>
    </message>
    <message>
        <source>Camera {serial}: {calibrated}. {words}</source>
        <translation>Kamera {serial}: {calibrated}. {words}</translation>
    </message>
    <message>
        <source>the reference contains both hands: {names} are used</source>
        <translation>In der Referenz sind beide Hände; verwendet werden {names}</translation>
    </message>
    <message>
        <source>no marker {wanted}, only {names}</source>
        <translation>kein Marker {wanted}, nur {names}</translation>
    </message>
    <message>
        <source>{several} found for {wanted}: state which one applies</source>
        <translation>für {wanted} gibt es {several}: geben Sie an, was davon gilt</translation>
    </message>
    <message>
        <source>line {line}: “{cell}” is not a reading</source>
        <translation>Zeile {line}: „{cell}“ ist kein Messwert</translation>
    </message>
    <message>
        <source>nothing</source>
        <translation>nichts</translation>
    </message>
    <message>
        <source>rows with the time of the previous row were excluded ({count})</source>
        <translation>Zeilen mit der Zeit der vorigen Zeile wurden ausgeschlossen ({count})</translation>
    </message>
    <message>
        <source>the cells of {name} are not times</source>
        <translation>die Zellen von {name} sind keine Zeiten</translation>
    </message>
    <message>
        <source>{names}: their names belong to the other hand</source>
        <translation>{names}: dem Namen nach von der anderen Hand</translation>
    </message>
    <message>
        <source>{name}: cells that are not numbers were excluded ({count}), the first is “{cell}” in line {line}</source>
        <translation>{name}: Zellen, die keine Zahl sind, wurden ausgeschlossen ({count}), die erste ist „{cell}“ in Zeile {line}</translation>
    </message>
    <message>
        <source>{name}: read as {unit}, because there is a row every {step}</source>
        <translation>{name}: als {unit} gelesen, da alle {step} eine Zeile kommt</translation>
    </message>
    <message>
        <source>no time column: state which of {names} it is</source>
        <translation>keine Zeitspalte; geben Sie an, welche von {names} es ist</translation>
    </message>
    <message>
        <source>no column reading_deg, only {names}</source>
        <translation>keine Spalte reading_deg, nur {names}</translation>
    </message>
    <message>
        <source>no column {wanted}, only {names}</source>
        <translation>keine Spalte {wanted}, nur {names}</translation>
    </message>
    <message>
        <source>no angle of the session, only {there}</source>
        <translation>kein Winkel der Sitzung, nur {there}</translation>
    </message>
    <message>
        <source>no palm marker and no angle of the wrist or fingers, only {there}</source>
        <translation>kein Marker der Hand und kein Winkel von Handgelenk oder Fingern, nur {there}</translation>
    </message>
    <message>
        <source>three palm markers are needed: state which of {there} they are</source>
        <translation>drei Marker der Mittelhand werden gebraucht: geben Sie an, welche von {there} es sind</translation>
    </message>
    <message>
        <source>depth in millimetres, not 5000 per metre</source>
        <translation>Tiefe in Millimetern, nicht 5000 pro Meter</translation>
    </message>
    <message>
        <source>depth_unit_m is not metres per count, as 0.001 or 0.0002</source>
        <translation>depth_unit_m gibt keine Meter pro Zählwert an, wie 0.001 oder 0.0002</translation>
    </message>
    <message>
        <source>times in {unit}, not in seconds</source>
        <translation>Zeiten in {unit}, nicht in Sekunden</translation>
    </message>
    <message>
        <source>Rotation from the start</source>
        <translation>Rotation seit dem Start</translation>
    </message>
    <message>
        <source>0° = thumb up</source>
        <translation>0° = Daumen oben</translation>
    </message>
    <message>
        <source>Forearm supination</source>
        <translation>Supination des Unterarms</translation>
    </message>
    <message>
        <source>Forearm pronation</source>
        <translation>Pronation des Unterarms</translation>
    </message>
    <message>
        <source>Rotation +</source>
        <translation>Rotation +</translation>
    </message>
    <message>
        <source>Rotation −</source>
        <translation>Rotation −</translation>
    </message>
    <message>
        <source>Thumb up</source>
        <translation>Daumen oben</translation>
    </message>
    <message>
        <source>As at the start</source>
        <translation>Wie beim Start</translation>
    </message>
    <message>
        <source>Forearm rotation</source>
        <translation>Unterarmrotation</translation>
    </message>
    <message>
        <source>Calibrate the camera again, or correct the file.</source>
        <translation>Kalibrieren Sie die Kamera neu, oder korrigieren Sie die Datei.</translation>
    </message>
    <message>
        <source>People: {people}, sessions: {sessions}.</source>
        <translation>Personen: {people}, Sitzungen: {sessions}.</translation>
    </message>
    <message>
        <source>measured once</source>
        <translation>einmal gemessen</translation>
    </message>
    <message>
        <source>Distance: near and far missing</source>
        <translation>Abstand: nah und fern fehlen</translation>
    </message>
    <message>
        <source>Tilts: {side} missing</source>
        <translation>Neigungen: {side} fehlt</translation>
    </message>
    <message>
        <source>Tilts: all sides</source>
        <translation>Neigungen: alle Seiten</translation>
    </message>
    <message>
        <source>Distance: {near}–{far} cm</source>
        <translation>Abstand: {near}–{far} cm</translation>
    </message>
    <message>
        <source>{px} px before</source>
        <translation>vorher {px} px</translation>
    </message>
    <message>
        <source>Hand not visible</source>
        <translation>Hand nicht sichtbar</translation>
    </message>
    <message>
        <source>Hold still</source>
        <translation>Stillhalten</translation>
    </message>
    <message>
        <source>Bend the wrist up, then down, as far as is comfortable. Keep the forearm still.</source>
        <translation>Das Handgelenk nach oben, dann nach unten beugen, so weit es angenehm ist. Der Unterarm bleibt still.</translation>
    </message>
    <message>
        <source>File not found: {subject}.</source>
        <translation>Datei nicht gefunden: {subject}.</translation>
    </message>
    <message>
        <source>Keep the MCP joints straight. Bend the PIP and DIP joints into a hook, then straighten.</source>
        <translation>Die MCP-Gelenke bleiben gestreckt. Die PIP- und DIP-Gelenke zum Haken beugen, dann strecken.</translation>
    </message>
    <message>
        <source>Tilt the hand towards the thumb, then towards the little finger. Keep the forearm still.</source>
        <translation>Die Hand zum Daumen neigen, dann zum Kleinfinger. Der Unterarm bleibt still.</translation>
    </message>
    <message>
        <source>Tilt your hand towards your little finger</source>
        <translation>Neigen Sie die Hand zum Kleinfinger</translation>
    </message>
    <message>
        <source>Tilt your hand towards your thumb</source>
        <translation>Neigen Sie die Hand zum Daumen</translation>
    </message>
    <message>
        <source>not a file</source>
        <translation>keine Datei</translation>
    </message>
    <message>
        <source>Passive range does not exceed active range by more than the measurement error.</source>
        <translation>Das passive Bewegungsausmaß übertrifft das aktive nicht um mehr als den Messfehler.</translation>
    </message>
    <message>
        <source>Record this exercise again.</source>
        <translation>Nehmen Sie diese Übung noch einmal auf.</translation>
    </message>
    <message>
        <source>no answer for {seconds} s</source>
        <translation>keine Antwort seit {seconds} s</translation>
    </message>
    <message>
        <source>not a recording journal</source>
        <translation>kein Aufnahmejournal</translation>
    </message>
    <message>
        <source>no answer</source>
        <translation>keine Antwort</translation>
    </message>
    <message>
        <source>the hand left the camera’s view during the movement</source>
        <translation>die Hand verließ während der Bewegung das Kamerabild</translation>
    </message>
    <message>
        <source>Compiled parts</source>
        <translation>Kompilierte Teile</translation>
    </message>
    <message>
        <source>complete</source>
        <translation>vollständig</translation>
    </message>
    <message>
        <source>A click lies outside the image: {subject} ({detail}).</source>
        <translation>Ein Klick liegt außerhalb des Bildes: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>A different camera is connected ({detail}). Carpus expects {subject}.</source>
        <translation>Eine andere Kamera ist angeschlossen ({detail}). Carpus erwartet {subject}.</translation>
    </message>
    <message>
        <source>A file with this name already exists: {subject}.</source>
        <translation>Eine Datei mit diesem Namen gibt es schon: {subject}.</translation>
    </message>
    <message>
        <source>A frame of the recording is damaged: {subject} ({detail}).</source>
        <translation>Ein Bild der Aufnahme ist beschädigt: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>A setting is invalid: {subject} ({detail}).</source>
        <translation>Eine Einstellung ist ungültig: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>All other files are in the backup.</source>
        <translation>Alle anderen Dateien sind in der Sicherung.</translation>
    </message>
    <message>
        <source>All other frames are used. The gaps are marked.</source>
        <translation>Alle anderen Bilder werden verwendet. Die Lücken sind markiert.</translation>
    </message>
    <message>
        <source>All sessions are safe. If there was a list before, its names, notes and comments are missing.</source>
        <translation>Alle Sitzungen sind sicher. Wenn es vorher eine Liste gab, fehlen ihre Namen, Notizen und Kommentare.</translation>
    </message>
    <message>
        <source>All sessions are safe. Names, notes and comments may be missing. The damaged list is kept as {subject}.</source>
        <translation>Alle Sitzungen sind sicher. Namen, Notizen und Kommentare können fehlen. Die beschädigte Liste bleibt als {subject} erhalten.</translation>
    </message>
    <message>
        <source>Another program is using the camera ({detail}).</source>
        <translation>Ein anderes Programm benutzt die Kamera ({detail}).</translation>
    </message>
    <message>
        <source>Another program is writing {subject}.</source>
        <translation>Ein anderes Programm schreibt gerade {subject}.</translation>
    </message>
    <message>
        <source>Ask your IT support for access to the camera.</source>
        <translation>Bitten Sie Ihre IT-Betreuung um Zugriff auf die Kamera.</translation>
    </message>
    <message>
        <source>Ask your IT support to install it.</source>
        <translation>Bitten Sie Ihre IT-Betreuung, das Paket zu installieren.</translation>
    </message>
    <message>
        <source>Ask your IT support to install the driver.</source>
        <translation>Bitten Sie Ihre IT-Betreuung, den Treiber zu installieren.</translation>
    </message>
    <message>
        <source>Ask your IT support to reinstall Carpus.</source>
        <translation>Bitten Sie Ihre IT-Betreuung, Carpus neu zu installieren.</translation>
    </message>
    <message>
        <source>Backup</source>
        <translation>Datensicherung</translation>
    </message>
    <message>
        <source>Calibrate the camera in the settings.</source>
        <translation>Kalibrieren Sie die Kamera in den Einstellungen.</translation>
    </message>
    <message>
        <source>Carpus was not installed completely: a compiled part is missing ({subject}).</source>
        <translation>Carpus wurde nicht vollständig installiert: Ein kompilierter Teil fehlt ({subject}).</translation>
    </message>
    <message>
        <source>Check that the network share is connected.</source>
        <translation>Prüfen Sie, ob die Netzwerkfreigabe verbunden ist.</translation>
    </message>
    <message>
        <source>Check the list, or restore a backup.</source>
        <translation>Prüfen Sie die Liste, oder stellen Sie eine Sicherung wieder her.</translation>
    </message>
    <message>
        <source>Choose an existing patient.</source>
        <translation>Wählen Sie einen vorhandenen Patienten.</translation>
    </message>
    <message>
        <source>Choose another backup, or update Carpus.</source>
        <translation>Wählen Sie eine andere Sicherung, oder aktualisieren Sie Carpus.</translation>
    </message>
    <message>
        <source>Choose the camera in the settings.</source>
        <translation>Wählen Sie die Kamera in den Einstellungen.</translation>
    </message>
    <message>
        <source>Choose the folder that contains the backups.</source>
        <translation>Wählen Sie den Ordner mit den Sicherungen.</translation>
    </message>
    <message>
        <source>Choose the folder that contains the patients.</source>
        <translation>Wählen Sie den Ordner mit den Patienten.</translation>
    </message>
    <message>
        <source>Choose the folder that contains the sessions.</source>
        <translation>Wählen Sie den Ordner mit den Sitzungen.</translation>
    </message>
    <message>
        <source>Click every marker again, in the order shown.</source>
        <translation>Klicken Sie alle Marker noch einmal an, in der gezeigten Reihenfolge.</translation>
    </message>
    <message>
        <source>Click the marker in the first frame of this recording.</source>
        <translation>Klicken Sie den Marker im ersten Bild dieser Aufnahme an.</translation>
    </message>
    <message>
        <source>Click the markers again, or correct the file.</source>
        <translation>Klicken Sie die Marker noch einmal an, oder korrigieren Sie die Datei.</translation>
    </message>
    <message>
        <source>Close Carpus on other computers. If that does not help, ask your IT support for write access.</source>
        <translation>Schließen Sie Carpus auf anderen Computern. Wenn das nicht hilft, bitten Sie Ihre IT-Betreuung um Schreibzugriff.</translation>
    </message>
    <message>
        <source>Comparison</source>
        <translation>Vergleich</translation>
    </message>
    <message>
        <source>Copy the recording again from its source.</source>
        <translation>Kopieren Sie die Aufnahme noch einmal von ihrer Quelle.</translation>
    </message>
    <message>
        <source>Correct the setting, or remove it to use the default.</source>
        <translation>Korrigieren Sie die Einstellung, oder entfernen Sie sie, um die Voreinstellung zu verwenden.</translation>
    </message>
    <message>
        <source>Damaged frames were excluded: {subject} ({detail}).</source>
        <translation>Beschädigte Bilder wurden ausgeschlossen: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Depth and colour are not aligned in {subject}, so depths are less accurate.</source>
        <translation>Tiefe und Farbe sind in {subject} nicht deckungsgleich, daher sind die Tiefen ungenauer.</translation>
    </message>
    <message>
        <source>Everything recorded before is safe.</source>
        <translation>Alles vorher Aufgenommene ist sicher.</translation>
    </message>
    <message>
        <source>Everything recorded so far is saved on this computer.</source>
        <translation>Alles bisher Aufgenommene ist auf diesem Computer gespeichert.</translation>
    </message>
    <message>
        <source>Everything saved until then is safe.</source>
        <translation>Alles bis dahin Gespeicherte ist sicher.</translation>
    </message>
    <message>
        <source>Exclude the repetitions that are wrong, or record again.</source>
        <translation>Schließen Sie die falschen Wiederholungen aus, oder nehmen Sie neu auf.</translation>
    </message>
    <message>
        <source>Files</source>
        <translation>Dateien</translation>
    </message>
    <message>
        <source>Frames with a repeated time were excluded: {subject} ({detail}).</source>
        <translation>Bilder mit wiederholter Zeit wurden ausgeschlossen: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Hold the whole printed board in the camera image, in good light.</source>
        <translation>Halten Sie die ganze gedruckte Tafel ins Kamerabild, bei gutem Licht.</translation>
    </message>
    <message>
        <source>If there are many, copy the recording again.</source>
        <translation>Wenn es viele sind, kopieren Sie die Aufnahme noch einmal.</translation>
    </message>
    <message>
        <source>If there are many, record again.</source>
        <translation>Wenn es viele sind, nehmen Sie neu auf.</translation>
    </message>
    <message>
        <source>Installation</source>
        <translation>Installation</translation>
    </message>
    <message>
        <source>Keep the light constant while you measure.</source>
        <translation>Lassen Sie das Licht während der Messung unverändert.</translation>
    </message>
    <message>
        <source>Measure at least 10 people twice within 14 days, and replace the markers each time.</source>
        <translation>Messen Sie mindestens 10 Personen zweimal innerhalb von 14 Tagen, jedes Mal mit neu gesetzten Markern.</translation>
    </message>
    <message>
        <source>Move the board further away</source>
        <translation>Tafel weiter weg</translation>
    </message>
    <message>
        <source>Move the camera further from the hand.</source>
        <translation>Rücken Sie die Kamera weiter von der Hand weg.</translation>
    </message>
    <message>
        <source>Move the hand a little. Keep sunlight and reflections off the markers.</source>
        <translation>Bewegen Sie die Hand ein wenig. Halten Sie Sonne und Spiegelungen von den Markern fern.</translation>
    </message>
    <message>
        <source>No camera was found ({detail}).</source>
        <translation>Es wurde keine Kamera gefunden ({detail}).</translation>
    </message>
    <message>
        <source>No separate blue marker was found at a click: {subject}.</source>
        <translation>An einer angeklickten Stelle wurde kein einzelner blauer Marker gefunden: {subject}.</translation>
    </message>
    <message>
        <source>Nothing else was changed.</source>
        <translation>Sonst wurde nichts geändert.</translation>
    </message>
    <message>
        <source>Nothing has been recorded yet.</source>
        <translation>Es wurde noch nichts aufgenommen.</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Es wurde nichts geändert.</translation>
    </message>
    <message>
        <source>Nothing was changed. New recordings are kept on this computer.</source>
        <translation>Es wurde nichts geändert. Neue Aufnahmen bleiben auf diesem Computer.</translation>
    </message>
    <message>
        <source>Nothing was deleted: {subject} is a link to another place.</source>
        <translation>Es wurde nichts gelöscht: {subject} ist eine Verknüpfung zu einem anderen Ort.</translation>
    </message>
    <message>
        <source>Patients</source>
        <translation>Patienten</translation>
    </message>
    <message>
        <source>Plug the camera directly into the computer.</source>
        <translation>Schließen Sie die Kamera direkt am Computer an.</translation>
    </message>
    <message>
        <source>Recent changes to the patient list cannot be read, because the folder is read-only: {subject}.</source>
        <translation>Die letzten Änderungen der Patientenliste können nicht gelesen werden, weil der Ordner schreibgeschützt ist: {subject}.</translation>
    </message>
    <message>
        <source>Reconnect the session folder or its disk, then back up again.</source>
        <translation>Verbinden Sie den Sitzungsordner oder seinen Datenträger wieder, und erstellen Sie dann eine neue Sicherung.</translation>
    </message>
    <message>
        <source>Record again with colour and depth of the same size.</source>
        <translation>Nehmen Sie neu auf. Farb- und Tiefenbilder müssen gleich groß sein.</translation>
    </message>
    <message>
        <source>Record again, or correct the list of frames.</source>
        <translation>Nehmen Sie neu auf, oder korrigieren Sie die Bildliste.</translation>
    </message>
    <message>
        <source>Record to a disk in this computer, and close other programs.</source>
        <translation>Speichern Sie die Aufnahme auf einem Datenträger in diesem Computer, und schließen Sie andere Programme.</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Recording not found: {subject} ({detail}).</source>
        <translation>Aufnahme nicht gefunden: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Restart Carpus. If that does not help, ask your IT support.</source>
        <translation>Starten Sie Carpus neu. Wenn das nicht hilft, fragen Sie Ihre IT-Betreuung.</translation>
    </message>
    <message>
        <source>Restore a backup, or enter the names again.</source>
        <translation>Stellen Sie eine Sicherung wieder her, oder geben Sie die Namen neu ein.</translation>
    </message>
    <message>
        <source>Review it like any other session.</source>
        <translation>Sehen Sie diese Sitzung wie jede andere durch.</translation>
    </message>
    <message>
        <source>Smoothing of this session failed: {subject} ({detail}).</source>
        <translation>Die Glättung dieser Sitzung ist fehlgeschlagen: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Someone else changed this record, so your change was not saved.</source>
        <translation>Jemand anderes hat diesen Eintrag geändert, deshalb wurde Ihre Änderung nicht gespeichert.</translation>
    </message>
    <message>
        <source>The backup cannot be read: {subject} ({detail}).</source>
        <translation>Die Sicherung kann nicht gelesen werden: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The calibration board is not visible: {subject} ({detail}).</source>
        <translation>Die Kalibriertafel ist nicht sichtbar: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The camera cannot keep its exposure constant: {subject}.</source>
        <translation>Die Kamera kann ihre Belichtung nicht konstant halten: {subject}.</translation>
    </message>
    <message>
        <source>The camera driver has stopped: {subject} ({detail}).</source>
        <translation>Der Kameratreiber läuft nicht mehr: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The camera driver is not installed or cannot be loaded ({detail}).</source>
        <translation>Der Kameratreiber ist nicht installiert oder kann nicht geladen werden ({detail}).</translation>
    </message>
    <message>
        <source>The camera file cannot be used: {subject} ({detail}).</source>
        <translation>Die Kameradatei kann nicht verwendet werden: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The camera has stopped sending images: {subject} ({detail}).</source>
        <translation>Die Kamera sendet keine Bilder mehr: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The camera’s calibration was not changed.</source>
        <translation>Die Kalibrierung der Kamera wurde nicht verändert.</translation>
    </message>
    <message>
        <source>The check card is not visible: {subject} ({detail}).</source>
        <translation>Die Prüfkarte ist nicht sichtbar: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The clicked markers cannot be read: {subject} ({detail}).</source>
        <translation>Die angeklickten Marker können nicht gelesen werden: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The clicked points do not form a hand ({subject}).</source>
        <translation>Die angeklickten Punkte ergeben keine Hand ({subject}).</translation>
    </message>
    <message>
        <source>The data on this computer are intact.</source>
        <translation>Die Daten auf diesem Computer sind unversehrt.</translation>
    </message>
    <message>
        <source>The disk has no space left for {subject} ({detail}).</source>
        <translation>Der Datenträger hat keinen Platz mehr für {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The disk is too slow, so the recording has ended: {subject} ({detail}).</source>
        <translation>Der Datenträger ist zu langsam, deshalb wurde die Aufnahme beendet: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The file was not changed. All other sessions are safe.</source>
        <translation>Die Datei wurde nicht verändert. Alle anderen Sitzungen sind sicher.</translation>
    </message>
    <message>
        <source>The first frame of the recording is damaged: {subject} ({detail}).</source>
        <translation>Das erste Bild der Aufnahme ist beschädigt: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The folder contains no Carpus data: {subject}.</source>
        <translation>Der Ordner enthält keine Daten von Carpus: {subject}.</translation>
    </message>
    <message>
        <source>The frame times are out of order: {subject} ({detail}).</source>
        <translation>Die Bildzeiten sind nicht in aufsteigender Reihenfolge: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The frames of the recording differ in size: {subject} ({detail}).</source>
        <translation>Die Bilder der Aufnahme sind unterschiedlich groß: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The image format of this recording is not supported: {subject} ({detail}).</source>
        <translation>Das Bildformat dieser Aufnahme wird nicht unterstützt: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The images of the board are too few or too similar: {subject} ({detail}).</source>
        <translation>Es gibt zu wenige Bilder der Tafel, oder sie sind einander zu ähnlich: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The live measurement is saved.</source>
        <translation>Die Live-Messung ist gespeichert.</translation>
    </message>
    <message>
        <source>The measurement continues.</source>
        <translation>Die Messung läuft weiter.</translation>
    </message>
    <message>
        <source>The other change is saved.</source>
        <translation>Die andere Änderung ist gespeichert.</translation>
    </message>
    <message>
        <source>The patient list cannot be opened: {subject} ({detail}).</source>
        <translation>Die Patientenliste kann nicht geöffnet werden: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The patient list is damaged: {subject} ({detail}).</source>
        <translation>Die Patientenliste ist beschädigt: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The patient list is open in another window of Carpus or another program: {subject} ({detail}).</source>
        <translation>Die Patientenliste ist in einem anderen Fenster von Carpus oder einem anderen Programm offen: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The patient list was damaged. It was rebuilt from the sessions and what could be read ({detail}).</source>
        <translation>Die Patientenliste war beschädigt. Sie wurde aus den Sitzungen und allem, was lesbar war, neu erstellt ({detail}).</translation>
    </message>
    <message>
        <source>The patient list was missing and was rebuilt from the sessions: {subject}.</source>
        <translation>Die Patientenliste fehlte und wurde aus den Sitzungen neu erstellt: {subject}.</translation>
    </message>
    <message>
        <source>The previous result was not changed.</source>
        <translation>Das bisherige Ergebnis wurde nicht verändert.</translation>
    </message>
    <message>
        <source>The re-analysis failed: {subject} ({detail}).</source>
        <translation>Die neue Analyse ist fehlgeschlagen: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The recording contains no frames: {subject} ({detail}).</source>
        <translation>Die Aufnahme enthält keine Bilder: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The session folder is not available ({detail}). The session is saved in {subject}.</source>
        <translation>Der Sitzungsordner ist nicht verfügbar ({detail}). Die Sitzung ist in {subject} gespeichert.</translation>
    </message>
    <message>
        <source>The session was not changed.</source>
        <translation>Die Sitzung wurde nicht verändert.</translation>
    </message>
    <message>
        <source>There is no backup in {subject}.</source>
        <translation>In {subject} gibt es keine Sicherung.</translation>
    </message>
    <message>
        <source>There is no patient called {subject} ({detail}).</source>
        <translation>Es gibt keinen Patienten namens {subject} ({detail}).</translation>
    </message>
    <message>
        <source>This camera does not deliver the images that Carpus needs: {subject} ({detail}).</source>
        <translation>Diese Kamera liefert nicht die Bilder, die Carpus braucht: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>This session cannot be opened: {subject} ({detail}).</source>
        <translation>Diese Sitzung kann nicht geöffnet werden: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>This session was modified after it was completed: {subject}.</source>
        <translation>Diese Sitzung wurde nach ihrem Abschluss verändert: {subject}.</translation>
    </message>
    <message>
        <source>Try again, or correct another frame first.</source>
        <translation>Versuchen Sie es noch einmal, oder korrigieren Sie zuerst ein anderes Bild.</translation>
    </message>
    <message>
        <source>Turn on depth registration in the camera settings next time.</source>
        <translation>Schalten Sie beim nächsten Mal die Ausrichtung von Tiefe und Farbe in den Kameraeinstellungen ein.</translation>
    </message>
    <message>
        <source>Type the name instead of pasting it.</source>
        <translation>Tippen Sie den Namen ein, statt ihn einzufügen.</translation>
    </message>
    <message>
        <source>Update Carpus on this computer.</source>
        <translation>Aktualisieren Sie Carpus auf diesem Computer.</translation>
    </message>
    <message>
        <source>Use a recording whose frames all have the same size.</source>
        <translation>Verwenden Sie eine Aufnahme, deren Bilder alle gleich groß sind.</translation>
    </message>
    <message>
        <source>Use a recording with colour and depth.</source>
        <translation>Verwenden Sie eine Aufnahme mit Farbe und Tiefe.</translation>
    </message>
    <message>
        <source>Use the same size for colour and depth next time.</source>
        <translation>Verwenden Sie beim nächsten Mal für Farbe und Tiefe dieselbe Größe.</translation>
    </message>
    <message>
        <source>Use the window that is already open, or choose another folder.</source>
        <translation>Verwenden Sie das schon offene Fenster, oder wählen Sie einen anderen Ordner.</translation>
    </message>
    <message>
        <source>Write “registered: true” or “registered: false” into camera_info.yaml.</source>
        <translation>Schreiben Sie „registered: true“ oder „registered: false“ in camera_info.yaml.</translation>
    </message>
    <message>
        <source>You do not have permission to open the camera ({detail}).</source>
        <translation>Sie haben keine Berechtigung, die Kamera zu öffnen ({detail}).</translation>
    </message>
    <message>
        <source>a study&apos;s table needs the columns person, session and reference</source>
        <translation>die Tabelle einer Studie braucht die Spalten person, session und reference</translation>
    </message>
    <message>
        <source>adults (ages not stated, not for children or older people)</source>
        <translation>Erwachsene (Alter nicht angegeben, nicht für Kinder und ältere Menschen)</translation>
    </message>
    <message>
        <source>it contains more than one record</source>
        <translation>enthält mehr als einen Datensatz</translation>
    </message>
    <message>
        <source>{value} is none of {choices}, in {file}</source>
        <translation>{value} ist keine dieser Angaben: {choices} (in {file})</translation>
    </message>
    <message>
        <source>{value} is not a number, in {file}</source>
        <translation>{value} ist keine Zahl (in {file})</translation>
    </message>
    <message>
        <source>{value} is not a text, in {file}</source>
        <translation>{value} ist kein Text (in {file})</translation>
    </message>
    <message>
        <source>{value} is not a whole number, in {file}</source>
        <translation>{value} ist keine ganze Zahl (in {file})</translation>
    </message>
    <message>
        <source>{value} is not true or false, in {file}</source>
        <translation>{value} ist weder true noch false (in {file})</translation>
    </message>
    <message>
        <source>{value} is not valid, in {file}</source>
        <translation>{value} ist ungültig (in {file})</translation>
    </message>
    <message>
        <source>“carpus track SESSION.h5 --output NEW.h5” repeats the smoothing.</source>
        <translation>„carpus track SITZUNG.h5 --output NEU.h5“ wiederholt die Glättung.</translation>
    </message>
    <message>
        <source>Last backup: {day}.</source>
        <translation>Letzte Sicherung: {day}.</translation>
    </message>
    <message>
        <source>An unexpected error occurred.</source>
        <translation>Ein unerwarteter Fehler ist aufgetreten.</translation>
    </message>
    <message>
        <source>Everything saved before is safe.</source>
        <translation>Alles vorher Gespeicherte ist sicher.</translation>
    </message>
    <message>
        <source>Try again. If it happens again, restart Carpus and show the details to your IT support.</source>
        <translation>Versuchen Sie es noch einmal. Wenn es wieder geschieht, starten Sie Carpus neu und zeigen Sie Ihrer IT-Betreuung die Details.</translation>
    </message>
    <message>
        <source>Program</source>
        <translation>Programm</translation>
    </message>
    <message>
        <source>Labels given while measuring ({count}) are not part of the new result. Check the markers.</source>
        <translation>Beim Messen vergebene Bezeichnungen ({count}) gehören nicht zum neuen Ergebnis. Prüfen Sie die Marker.</translation>
    </message>
    <message>
        <source>Rarely visible in the new result: {names}. Their angles are missing there.</source>
        <translation>Im neuen Ergebnis kaum sichtbar: {names}. Deren Winkel fehlen dort.</translation>
    </message>
    <message>
        <source>{count} of {common} frames differ by more than 2°. Largest difference at {time}: {angle}, {size}.</source>
        <translation>{count} von {common} Bildern weichen um mehr als 2° ab. Größter Unterschied bei {time}: {angle}, {size}.</translation>
    </message>
    <message>
        <source>No frame differs by more than 2°.</source>
        <translation>Kein Bild weicht um mehr als 2° ab.</translation>
    </message>
    <message>
        <source>{count} frames have an angle that was missing before.</source>
        <translation>{count} Bilder haben einen Winkel, der vorher fehlte.</translation>
    </message>
    <message>
        <source>Live values are compared, because one of the two results is not smoothed.</source>
        <translation>Verglichen werden die Live-Werte, weil eines der beiden Ergebnisse nicht geglättet ist.</translation>
    </message>
    <message>
        <source>excluded: simulated</source>
        <translation>ausgeschlossen: simuliert</translation>
    </message>
    <message>
        <source>excluded: {reason}</source>
        <translation>ausgeschlossen: {reason}</translation>
    </message>
    <message>
        <source>file missing</source>
        <translation>Datei fehlt</translation>
    </message>
    <message>
        <source>This image cannot be read. Choose a PNG or JPEG file.</source>
        <translation>Dieses Bild kann nicht gelesen werden. Wählen Sie eine PNG- oder JPEG-Datei.</translation>
    </message>
    <message>
        <source>This image is larger than 8 MB. Choose a smaller one.</source>
        <translation>Dieses Bild ist größer als 8 MB. Wählen Sie ein kleineres.</translation>
    </message>
    <message>
        <source>Carpus cannot read this file as an image. Choose a PNG or JPEG file.</source>
        <translation>Carpus kann diese Datei nicht als Bild lesen. Wählen Sie eine PNG- oder JPEG-Datei.</translation>
    </message>
    <message>
        <source>This image is too small to print. Choose one of at least 32 × 32 pixels.</source>
        <translation>Dieses Bild ist zu klein zum Drucken. Wählen Sie eines mit mindestens 32 × 32 Pixeln.</translation>
    </message>
    <message>
        <source>Rotation</source>
        <translation>Rotation</translation>
    </message>
    <message>
        <source>Frames with occluded joints are not analysed.</source>
        <translation>Bilder mit verdeckten Gelenken werden nicht ausgewertet.</translation>
    </message>
    <message>
        <source>Nothing was changed. Glue the board onto something flat and stiff. Take the images again in good light.</source>
        <translation>Es wurde nichts geändert. Kleben Sie die Tafel auf etwas Flaches, Steifes, und nehmen Sie die Bilder bei gutem Licht neu auf.</translation>
    </message>
    <message>
        <source>Depth was not checked.</source>
        <translation>Die Tiefe wurde nicht geprüft.</translation>
    </message>
    <message>
        <source>Lay the card flat under the camera, fully in view, about 60 cm away.</source>
        <translation>Legen Sie die Karte flach unter die Kamera, ganz im Bild, etwa 60 cm entfernt.</translation>
    </message>
    <message>
        <source>The card moved: the countdown starts again.</source>
        <translation>Die Karte hat sich bewegt: Der Countdown beginnt neu.</translation>
    </message>
    <message>
        <source>Abduction</source>
        <translation>Abduktion</translation>
    </message>
    <message>
        <source>Extended</source>
        <translation>Gestreckt</translation>
    </message>
    <message>
        <source>Flexed {angle}</source>
        <translation>Gebeugt {angle}</translation>
    </message>
    <message>
        <source>add.</source>
        <translation>Add.</translation>
    </message>
    <message>
        <source>abd.</source>
        <translation>Abd.</translation>
    </message>
    <message>
        <source>Abd. {angle}</source>
        <translation>Abd. {angle}</translation>
    </message>
    <message>
        <source>Add. {angle}</source>
        <translation>Add. {angle}</translation>
    </message>
    <message>
        <source>Check the {marker}</source>
        <translation>Prüfen Sie „{marker}“</translation>
    </message>
    <message>
        <source>Hand tracked well</source>
        <translation>Hand gut erfasst</translation>
    </message>
    <message>
        <source>manual, active</source>
        <translation>manuell, aktiv</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>too slow to assess</source>
        <translation>zu langsam für eine Beurteilung</translation>
    </message>
    <message>
        <source>abduction</source>
        <translation>Abduktion</translation>
    </message>
    <message>
        <source>abduction of {fingers}</source>
        <translation>Abduktion: {fingers}</translation>
    </message>
    <message>
        <source>Partly occluded ({sign} = minimum): {parts}. Frames with occluded joints are not analysed.</source>
        <translation>Teilweise verdeckt ({sign} = Mindestwert): {parts}. Bilder mit verdeckten Gelenken werden nicht ausgewertet.</translation>
    </message>
    <message>
        <source>Abduction of all fingers</source>
        <translation>Abduktion aller Finger</translation>
    </message>
    <message>
        <source>Position, speed, rotation</source>
        <translation>Position, Geschwindigkeit, Rotation</translation>
    </message>
    <message>
        <source>Manual measurements</source>
        <translation>Manuelle Messungen</translation>
    </message>
    <message>
        <source>Therapist’s comment</source>
        <translation>Therapeutischer Kommentar</translation>
    </message>
    <message>
        <source>The comment is too long for this letter. It is in the report.</source>
        <translation>Der Kommentar ist für diesen Brief zu lang. Er steht im Bericht.</translation>
    </message>
    <message>
        <source>{count} movement cycles; range over the whole recording</source>
        <translation>{count} Bewegungszyklen; Bewegungsausmaß über die ganze Aufnahme</translation>
    </message>
    <message>
        <source>too short</source>
        <translation>zu kurz</translation>
    </message>
    <message>
        <source>± = SD between repetitions. The SD of a visible angle is about {sd}.</source>
        <translation>± = SD zwischen den Wiederholungen. Die SD eines sichtbaren Winkels ist etwa {sd}.</translation>
    </message>
    <message>
        <source>± = SD between repetitions (with fewer than 3: SD of the estimate). The SD of a visible angle is about {sd}.</source>
        <translation>± = SD zwischen den Wiederholungen (bei weniger als 3: SD der Schätzung). Die SD eines sichtbaren Winkels ist etwa {sd}.</translation>
    </message>
    <message>
        <source>± = SD of the estimate, as there are too few repetitions. The SD of an angle is about {sd}.</source>
        <translation>± = SD der Schätzung, da es zu wenige Wiederholungen gibt. Die SD eines Winkels ist etwa {sd}.</translation>
    </message>
    <message>
        <source>{share} of {frames}; {dropped} dropped</source>
        <translation>{share} von {frames}; {dropped} ausgefallen</translation>
    </message>
    <message>
        <source>Exercise set: {name}</source>
        <translation>Übungsfolge: {name}</translation>
    </message>
    <message>
        <source>Camera permissions, {title}</source>
        <translation>Kamerarechte, {title}</translation>
    </message>
    <message>
        <source>Reinstall it and the library it names.</source>
        <translation>Installieren Sie den Treiber und die genannte Bibliothek neu.</translation>
    </message>
    <message>
        <source>Install the camera permissions named above and plug the camera in again.</source>
        <translation>Installieren Sie die oben genannten Kamerarechte, und schließen Sie die Kamera neu an.</translation>
    </message>
    <message>
        <source>Depth registration</source>
        <translation>Ausrichtung von Tiefe und Farbe</translation>
    </message>
    <message>
        <source>You have no permission to open {node}. Install the camera permissions named above, then plug the camera in again.</source>
        <translation>Keine Berechtigung für {node}. Installieren Sie die oben genannten Kamerarechte, und schließen Sie die Kamera neu an.</translation>
    </message>
    <message>
        <source>angles from a table</source>
        <translation>Winkel aus Tabelle</translation>
    </message>
    <message>
        <source>angles from {format}</source>
        <translation>Winkel aus {format}</translation>
    </message>
    <message>
        <source>no limits, so the default limits apply</source>
        <translation>keine Grenzen enthalten; es gelten die Standardgrenzen</translation>
    </message>
    <message>
        <source>no marker {name}</source>
        <translation>kein Marker {name}</translation>
    </message>
    <message>
        <source>no frame {number}</source>
        <translation>kein Bild {number}</translation>
    </message>
    <message>
        <source>no saved blue spots</source>
        <translation>keine gespeicherten blauen Stellen</translation>
    </message>
    <message>
        <source>folder not writable</source>
        <translation>Ordner nicht beschreibbar</translation>
    </message>
    <message>
        <source>process ended</source>
        <translation>Prozess beendet</translation>
    </message>
    <message>
        <source>marker set {subject}</source>
        <translation>Markersatz {subject}</translation>
    </message>
    <message>
        <source>points from {format}</source>
        <translation>Punkte aus {format}</translation>
    </message>
    <message>
        <source>{folder}, created at the first recording</source>
        <translation>{folder}, wird bei der ersten Aufnahme angelegt</translation>
    </message>
    <message>
        <source>The language can be changed once no measurement or analysis is running.</source>
        <translation>Die Sprache lässt sich ändern, wenn keine Messung oder Analyse mehr läuft.</translation>
    </message>
    <message>
        <source>invisible character</source>
        <translation>unsichtbares Zeichen</translation>
    </message>
    <message>
        <source>Manual</source>
        <translation>Manuell</translation>
    </message>
    <message>
        <source>0° = neutral position</source>
        <translation>0° = Neutralstellung</translation>
    </message>
    <message>
        <source>Neutral</source>
        <translation>Neutral</translation>
    </message>
    <message>
        <source>Ab-/adduction</source>
        <translation>Ab-/Adduktion</translation>
    </message>
    <message>
        <source>Their sessions stay separate.</source>
        <translation>Die Sitzungen der beiden Patienten bleiben getrennt.</translation>
    </message>
    <message>
        <source>Hide or show names</source>
        <translation>Namen aus- oder einblenden</translation>
    </message>
    <message>
        <source>born {day}</source>
        <translation>geb. {day}</translation>
    </message>
    <message>
        <source>No. {number}</source>
        <translation>Nr. {number}</translation>
    </message>
    <message>
        <source>female</source>
        <translation>weiblich</translation>
    </message>
    <message>
        <source>male</source>
        <translation>männlich</translation>
    </message>
    <message>
        <source>Connect the expected camera. Measurement and recording then continue automatically.</source>
        <translation>Schließen Sie die erwartete Kamera an. Messung und Aufnahme laufen dann automatisch weiter.</translation>
    </message>
    <message>
        <source>Plug the camera in again. Measurement and recording then continue automatically.</source>
        <translation>Schließen Sie die Kamera wieder an. Messung und Aufnahme laufen dann automatisch weiter.</translation>
    </message>
    <message>
        <source>no colour images of {width} × {height} pixels</source>
        <translation>keine Farbbilder mit {width} × {height} Pixeln</translation>
    </message>
    <message>
        <source>no depth</source>
        <translation>keine Tiefe</translation>
    </message>
    <message>
        <source>no frames for {seconds} s</source>
        <translation>keine Bilder seit {seconds} s</translation>
    </message>
    <message>
        <source>unplugged</source>
        <translation>abgezogen</translation>
    </message>
    <message>
        <source>“carpus doctor” shows how to grant it.</source>
        <translation>„carpus doctor“ zeigt, wie der Zugriff erteilt wird.</translation>
    </message>
    <message>
        <source>“carpus doctor” shows what is missing and how to install it.</source>
        <translation>„carpus doctor“ zeigt, was fehlt und wie es installiert wird.</translation>
    </message>
    <message>
        <source>{detail} in the session folder cannot be read and were ignored: {subject}.</source>
        <translation>Im Sitzungsordner nicht lesbar und daher ignoriert ({detail}): {subject}.</translation>
    </message>
    <message>
        <source>{name} is plugged in, but the driver does not see it</source>
        <translation>{name} ist angeschlossen, aber der Treiber erkennt die Kamera nicht</translation>
    </message>
    <message>
        <source>Remove files that do not belong to Carpus, or choose another disk.</source>
        <translation>Entfernen Sie Dateien, die nicht zu Carpus gehören, oder wählen Sie einen anderen Datenträger.</translation>
    </message>
    <message>
        <source>no fonts of Carpus</source>
        <translation>keine Schriften von Carpus</translation>
    </message>
    <message>
        <source>camera clock {own_s} s, computer clock {here_s} s</source>
        <translation>Uhr der Kamera {own_s} s, Uhr des Computers {here_s} s</translation>
    </message>
    <message>
        <source>unknown character set {number}</source>
        <translation>unbekannter Zeichensatz {number}</translation>
    </message>
    <message>
        <source>no record type at the start</source>
        <translation>keine Satzart am Anfang</translation>
    </message>
    <message>
        <source>record type {number}, 6302 or 6301 expected</source>
        <translation>Satzart {number}, erwartet ist 6302 oder 6301</translation>
    </message>
    <message>
        <source>no patient number</source>
        <translation>Patientennummer fehlt</translation>
    </message>
    <message>
        <source>end missing</source>
        <translation>Ende fehlt</translation>
    </message>
    <message>
        <source>line {number}: length differs from the stated one</source>
        <translation>Zeile {number}: Länge weicht von der angegebenen ab</translation>
    </message>
    <message>
        <source>line {number} is not a GDT line</source>
        <translation>Zeile {number} ist keine GDT-Zeile</translation>
    </message>
    <message>
        <source>other</source>
        <translation>divers</translation>
    </message>
    <message>
        <source>Waiting patients: {count}.</source>
        <translation>Wartende Patienten: {count}.</translation>
    </message>
    <message>
        <source>Results can be written.</source>
        <translation>Ergebnisse können geschrieben werden.</translation>
    </message>
    <message>
        <source>A folder cannot be used: {reason}</source>
        <translation>Ein Ordner kann nicht verwendet werden: {reason}</translation>
    </message>
    <message>
        <source>{count} pairs of one session, compared with {kind}</source>
        <translation>{count} Paare einer Sitzung, verglichen mit: {kind}</translation>
    </message>
    <message>
        <source>{count} joint angles whose names differ from {name}</source>
        <translation>{count} Gelenkwinkel mit anderen Namen als {name}</translation>
    </message>
    <message>
        <source>{wrong}, not supported for an image folder</source>
        <translation>{wrong}, bei einem Bilderordner nicht unterstützt</translation>
    </message>
    <message>
        <source>Backups cannot be saved there: {subject} ({detail}).</source>
        <translation>Sicherungen können dort nicht gespeichert werden: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Pain, note</source>
        <translation>Schmerz, Notiz</translation>
    </message>
    <message>
        <source>{count} per movement, {seconds} s in total</source>
        <translation>{count} je Bewegung, insgesamt {seconds} s</translation>
    </message>
    <message>
        <source>revision {digest}</source>
        <translation>Programmstand {digest}</translation>
    </message>
    <message>
        <source>In the middle of the nail.</source>
        <translation>In der Mitte des Nagels.</translation>
    </message>
    <message>
        <source>{share} % of the repetition time</source>
        <translation>{share} % der Wiederholungszeit</translation>
    </message>
    <message>
        <source>Measured on {date} with {count} people in {sessions} sessions. 95 % confidence intervals are in brackets.</source>
        <translation>Gemessen am {date} mit {count} Personen in {sessions} Sitzungen. In Klammern stehen 95-%-Konfidenzintervalle.</translation>
    </message>
    <message>
        <source>Forearm pronation and supination are measured from thumb up (0°). Palm flat on the table is 90° pronation.</source>
        <translation>Pronation und Supination des Unterarms werden ab „Daumen oben“ (0°) gemessen. Die Handfläche flach auf dem Tisch entspricht 90° Pronation.</translation>
    </message>
    <message>
        <source>Save the report as a PDF. It contains only the pseudonym.</source>
        <translation>Speichern Sie den Bericht als PDF. Er enthält nur das Pseudonym.</translation>
    </message>
    <message>
        <source>A recording still on this computer belonged to a deleted patient and was deleted as well.</source>
        <translation>Eine Aufnahme, die noch auf diesem Computer lag, gehörte zu einem gelöschten Patienten und wurde ebenfalls gelöscht.</translation>
    </message>
    <message>
        <source>A required Python package is not installed: {subject}.</source>
        <translation>Ein benötigtes Python-Paket ist nicht installiert: {subject}.</translation>
    </message>
    <message>
        <source>Another Carpus program is using this data folder: {subject}.</source>
        <translation>Carpus läuft schon einmal mit diesem Datenordner: {subject}.</translation>
    </message>
    <message>
        <source>Ask your IT support to replace the link with its target, then delete again.</source>
        <translation>Bitten Sie Ihre IT-Betreuung, die Verknüpfung durch ihr Ziel zu ersetzen, und löschen Sie dann noch einmal.</translation>
    </message>
    <message>
        <source>On the command line, set it with --camera.</source>
        <translation>In der Befehlszeile wird die Kamera mit --camera angegeben.</translation>
    </message>
    <message>
        <source>This line must be 100 mm long. If it is not,</source>
        <translation>Diese Linie muss 100 mm lang sein. Wenn nicht,</translation>
    </message>
    <message>
        <source>The camera cannot measure the depth at a marker: {subject}.</source>
        <translation>Die Kamera kann an einem Marker keine Tiefe messen: {subject}.</translation>
    </message>
    <message>
        <source>The camera cannot measure the depth at the {markers}.</source>
        <translation>Die Kamera kann hier keine Tiefe messen: {markers}.</translation>
    </message>
    <message>
        <source>The session and the reference were not changed.</source>
        <translation>Die Sitzung und die Referenz wurden nicht verändert.</translation>
    </message>
    <message>
        <source>a colour image instead of a 16-bit depth image</source>
        <translation>ein Farbbild statt eines Tiefenbilds mit 16 Bit</translation>
    </message>
    <message>
        <source>a depth image of {value} bits instead of 16</source>
        <translation>ein Tiefenbild mit {value} Bit statt 16</translation>
    </message>
    <message>
        <source>a grey image instead of a colour image</source>
        <translation>ein Graubild statt eines Farbbilds</translation>
    </message>
    <message>
        <source>format version {version}, but this version of Carpus reads up to {format_version}</source>
        <translation>Formatversion {version}, diese Version von Carpus liest aber nur bis {format_version}</translation>
    </message>
    <message>
        <source>format version {version}, but this version of Carpus reads {newest}</source>
        <translation>Formatversion {version}, diese Version von Carpus liest aber {newest}</translation>
    </message>
    <message>
        <source>line {line}: there is no angle called {said}</source>
        <translation>Zeile {line}: kein Winkel heißt {said}</translation>
    </message>
    <message>
        <source>not in a recording format that Carpus can read</source>
        <translation>kein Aufnahmeformat, das Carpus lesen kann</translation>
    </message>
    <message>
        <source>not tracked with the Carpus filter</source>
        <translation>nicht mit dem Filter von Carpus ausgewertet</translation>
    </message>
    <message>
        <source>unknown angle name, or angle of the other hand</source>
        <translation>unbekannter Winkelname oder Winkel der anderen Hand</translation>
    </message>
    <message>
        <source>unknown marker name, marker of the other hand, or never visible</source>
        <translation>unbekannter Markername, Marker der anderen Hand oder nie sichtbar</translation>
    </message>
    <message>
        <source>version {version}, but this version of Carpus reads up to {count}</source>
        <translation>Version {version}, diese Version von Carpus liest aber nur bis {count}</translation>
    </message>
    <message>
        <source>{bits} bits per colour instead of 8</source>
        <translation>{bits} Bit je Farbe statt 8</translation>
    </message>
    <message>
        <source>{capacity} rows not yet written</source>
        <translation>{capacity} Zeilen noch nicht geschrieben</translation>
    </message>
    <message>
        <source>{name}, outward</source>
        <translation>{name}, hin</translation>
    </message>
    <message>
        <source>{name}, return</source>
        <translation>{name}, zurück</translation>
    </message>
    <message>
        <source>invalid birth date</source>
        <translation>ungültiges Geburtsdatum</translation>
    </message>
    <message>
        <source>rotation from the start, + = thumb side up</source>
        <translation>Rotation ab dem Start, + = Daumenseite hoch</translation>
    </message>
    <message>
        <source>from the start, + = thumb side up; {within}</source>
        <translation>ab dem Start, + = Daumenseite hoch; {within}</translation>
    </message>
    <message>
        <source>{finger}, TAM</source>
        <translation>{finger}, TAM</translation>
    </message>
    <message>
        <source>{finger}, fingertip to palm</source>
        <translation>{finger}, Fingerkuppen-Hohlhand-Abstand</translation>
    </message>
    <message>
        <source>Finger joints, goniometer (°)</source>
        <translation>Fingergelenke, Goniometer (°)</translation>
    </message>
    <message>
        <source>Enter a number from {least} to {most}, or leave it empty</source>
        <translation>Geben Sie eine Zahl von {least} bis {most} ein, oder lassen Sie das Feld leer</translation>
    </message>
    <message>
        <source>removed</source>
        <translation>entfernt</translation>
    </message>
    <message>
        <source>Previous entries for this day:</source>
        <translation>Frühere Einträge für diesen Tag:</translation>
    </message>
    <message>
        <source>Kapandji score</source>
        <translation>Kapandji-Index</translation>
    </message>
    <message>
        <source>Patient</source>
        <translation>Patient</translation>
    </message>
    <message>
        <source>Diagnosis or operation</source>
        <translation>Diagnose oder Operation</translation>
    </message>
    <message>
        <source>Last session</source>
        <translation>Letzte Sitzung</translation>
    </message>
    <message>
        <source>About half-way the PIP joints are occluded. Their range is a minimum value (≥).</source>
        <translation>Etwa ab der Hälfte sind die PIP-Gelenke verdeckt. Ihr Bewegungsausmaß ist ein Mindestwert (≥).</translation>
    </message>
    <message>
        <source>At the end of a fist the PIP and DIP joints are occluded. Their ranges are minimum values (≥).</source>
        <translation>Am Ende des Faustschlusses sind die PIP- und DIP-Gelenke verdeckt. Ihre Bewegungsausmaße sind Mindestwerte (≥).</translation>
    </message>
    <message>
        <source>Below about 25° of pronation the markers are occluded. Only the visible part is measured.</source>
        <translation>Unter etwa 25° Pronation sind die Marker verdeckt. Nur der sichtbare Teil wird gemessen.</translation>
    </message>
    <message>
        <source>Occluded joints are not measured.</source>
        <translation>Verdeckte Gelenke werden nicht gemessen.</translation>
    </message>
    <message>
        <source>The abduction of a flexed finger is unreliable. Keep the fingers straight.</source>
        <translation>Die Abduktion eines gebeugten Fingers ist unzuverlässig. Finger gestreckt halten.</translation>
    </message>
    <message>
        <source>Under the palm the thumb tip is occluded. Palmar abduction of the thumb stays visible.</source>
        <translation>Unter der Handfläche ist die Daumenspitze verdeckt. Die Palmarabduktion des Daumens bleibt sichtbar.</translation>
    </message>
    <message>
        <source>Exercise</source>
        <translation>Übung</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Analysed</source>
        <translation>Gewertet</translation>
    </message>
    <message>
        <source>no opposition</source>
        <translation>keine Opposition</translation>
    </message>
    <message>
        <source>index finger, side of the middle phalanx</source>
        <translation>Zeigefinger, Seite des Mittelglieds</translation>
    </message>
    <message>
        <source>index finger, side of the distal phalanx</source>
        <translation>Zeigefinger, Seite des Endglieds</translation>
    </message>
    <message>
        <source>tip of the index finger</source>
        <translation>Spitze des Zeigefingers</translation>
    </message>
    <message>
        <source>tip of the middle finger</source>
        <translation>Spitze des Mittelfingers</translation>
    </message>
    <message>
        <source>tip of the ring finger</source>
        <translation>Spitze des Ringfingers</translation>
    </message>
    <message>
        <source>tip of the little finger</source>
        <translation>Spitze des Kleinfingers</translation>
    </message>
    <message>
        <source>little finger, DIP crease</source>
        <translation>Kleinfinger, DIP-Beugefalte</translation>
    </message>
    <message>
        <source>little finger, PIP crease</source>
        <translation>Kleinfinger, PIP-Beugefalte</translation>
    </message>
    <message>
        <source>little finger, proximal crease</source>
        <translation>Kleinfinger, proximale Beugefalte</translation>
    </message>
    <message>
        <source>distal palmar crease</source>
        <translation>distale Hohlhandfalte</translation>
    </message>
    <message>
        <source>The therapist’s comment is on the last {count} pages.</source>
        <translation>Der therapeutische Kommentar steht auf den letzten {count} Seiten.</translation>
    </message>
    <message>
        <source>Curves and repetitions</source>
        <translation>Kurven und Wiederholungen</translation>
    </message>
    <message>
        <source>Motion page</source>
        <translation>Seite mit Bewegungsdaten</translation>
    </message>
    <message>
        <source>Reliability of the values</source>
        <translation>Zuverlässigkeit der Werte</translation>
    </message>
    <message>
        <source>Table</source>
        <translation>Tabelle</translation>
    </message>
    <message>
        <source>{value} is unusual. Typical range: {low} to {high}</source>
        <translation>{value} ist ungewöhnlich. Üblicher Bereich: {low} bis {high}</translation>
    </message>
    <message>
        <source>The sessions are shown side by side, but not compared.</source>
        <translation>Die Sitzungen werden nebeneinander gezeigt, aber nicht verglichen.</translation>
    </message>
    <message>
        <source>The image is too dark: add light.</source>
        <translation>Das Bild ist zu dunkel: Mehr Licht geben.</translation>
    </message>
    <message>
        <source>Tilt the board less: the camera sees it almost edge-on.</source>
        <translation>Tafel weniger neigen: Man sieht fast nur die Kante.</translation>
    </message>
    <message>
        <source>The image is blurred: hold the board still, or add light.</source>
        <translation>Das Bild ist unscharf: Tafel stillhalten oder mehr Licht geben.</translation>
    </message>
    <message>
        <source>Calculate · more positions and tilts</source>
        <translation>Berechnen · mehr Positionen und Neigungen</translation>
    </message>
    <message>
        <source>The board is not visible: show the whole board, flat, in even light.</source>
        <translation>Tafel nicht sichtbar: Zeigen Sie sie ganz und flach, bei gleichmäßigem Licht.</translation>
    </message>
    <message>
        <source>Depth–colour alignment</source>
        <translation>Ausrichtung Tiefe–Farbe</translation>
    </message>
    <message>
        <source>depth registration is off</source>
        <translation>Ausrichtung ist aus</translation>
    </message>
    <message>
        <source>This camera reports no serial number, so its calibration cannot be saved here. IT support can write it to a camera file with “carpus calibrate-camera --output” and enter that file in the settings.</source>
        <translation>Diese Kamera meldet keine Seriennummer. Deshalb kann ihre Kalibrierung hier nicht gespeichert werden. Die IT-Betreuung kann sie mit „carpus calibrate-camera --output“ in eine Kameradatei schreiben und diese in den Einstellungen angeben.</translation>
    </message>
    <message>
        <source>Show the next angle as the large number</source>
        <translation>Nächster Winkel als große Zahl</translation>
    </message>
    <message>
        <source>Show the next finger as the large number</source>
        <translation>Nächster Finger als große Zahl</translation>
    </message>
    <message>
        <source>Move the start or end of the repetition earlier</source>
        <translation>Anfang oder Ende der Wiederholung früher legen</translation>
    </message>
    <message>
        <source>Move the start or end of the repetition later</source>
        <translation>Anfang oder Ende der Wiederholung später legen</translation>
    </message>
    <message>
        <source>Zoom in on the curves</source>
        <translation>Kurven vergrößern</translation>
    </message>
    <message>
        <source>Zoom out of the curves</source>
        <translation>Kurven verkleinern</translation>
    </message>
    <message>
        <source>Show the whole recording</source>
        <translation>Ganze Aufnahme anzeigen</translation>
    </message>
    <message>
        <source>Select the previous session</source>
        <translation>Vorige Sitzung auswählen</translation>
    </message>
    <message>
        <source>Select the next session</source>
        <translation>Nächste Sitzung auswählen</translation>
    </message>
    <message>
        <source>Previous frame (correction)</source>
        <translation>Voriges Bild (Korrektur)</translation>
    </message>
    <message>
        <source>Next frame (correction)</source>
        <translation>Nächstes Bild (Korrektur)</translation>
    </message>
    <message>
        <source>Undo the last step</source>
        <translation>Letzten Schritt rückgängig machen</translation>
    </message>
    <message>
        <source>Save an image of the hand only</source>
        <translation>Bild nur von der Hand speichern</translation>
    </message>
    <message>
        <source>Tick a session for comparison</source>
        <translation>Sitzung zum Vergleichen ankreuzen</translation>
    </message>
    <message>
        <source>Show the whole image or only the hand</source>
        <translation>Ganzes Bild oder nur die Hand anzeigen</translation>
    </message>
    <message>
        <source>Open or close the patient’s view</source>
        <translation>Patientenansicht öffnen oder schließen</translation>
    </message>
    <message>
        <source>Undo the last click</source>
        <translation>Letzten Klick zurücknehmen</translation>
    </message>
    <message>
        <source>Swap two labels</source>
        <translation>Zwei Bezeichnungen tauschen</translation>
    </message>
    <message>
        <source>Click the marker again</source>
        <translation>Marker neu anklicken</translation>
    </message>
    <message>
        <source>No angle yet</source>
        <translation>Noch kein Winkel bekannt</translation>
    </message>
    <message>
        <source>{marker} often occluded</source>
        <translation>{marker} oft verdeckt</translation>
    </message>
    <message>
        <source>{count} markers often occluded</source>
        <translation>{count} Marker oft verdeckt</translation>
    </message>
    <message>
        <source>The line of each finger should run from the wrist to the fingertip. To change a label, drag it to another marker.</source>
        <translation>Die Linie jedes Fingers soll vom Handgelenk zur Fingerspitze laufen. Zum Ändern eine Bezeichnung auf einen anderen Marker ziehen.</translation>
    </message>
    <message>
        <source>all {count} found</source>
        <translation>alle {count} gefunden</translation>
    </message>
    <message>
        <source>reading number</source>
        <translation>Nummer der Ablesung</translation>
    </message>
    <message>
        <source>mean ± SD of the repetitions</source>
        <translation>Mittelwert ± SD der Wiederholungen</translation>
    </message>
    <message>
        <source>α and γ are shown only where their SD is below 30° ({share} of the time). Near the neutral position, only β and α + γ can be measured.</source>
        <translation>α und γ sind nur dort angegeben, wo ihre SD unter 30° bleibt ({share} der Zeit): Nahe der Neutralstellung sind nur β und α + γ bestimmbar.</translation>
    </message>
    <message>
        <source>{name}, across the palm</source>
        <translation>{name}, zur Handfläche</translation>
    </message>
    <message>
        <source>Plausible position while occluded</source>
        <translation>Handstellung bei Verdeckung plausibel</translation>
    </message>
    <message>
        <source>Position known to within 15° while occluded</source>
        <translation>Handstellung bei Verdeckung auf 15° genau bekannt</translation>
    </message>
    <message>
        <source>Position jump when visible again</source>
        <translation>Positionssprung beim Wiederauftauchen</translation>
    </message>
    <message>
        <source>Delay of {other} after {one}</source>
        <translation>Verzögerung: {other} nach {one}</translation>
    </message>
    <message>
        <source>Involuntary movement of {other} with {one}</source>
        <translation>Mitbewegung: {other} bei {one}</translation>
    </message>
    <message>
        <source>DIP not measured: TAM uses two thirds of the PIP flexion.</source>
        <translation>DIP nicht gemessen: Die TAM rechnet mit zwei Dritteln der PIP-Flexion.</translation>
    </message>
    <message>
        <source>with the axes of the hand along the path</source>
        <translation>mit den Achsen der Hand entlang der Bahn</translation>
    </message>
    <message>
        <source>band: ± 1 SD; black: α + γ</source>
        <translation>Band: ± 1 SD; schwarz: α + γ</translation>
    </message>
    <message>
        <source>mean ± SD; right column: {day}</source>
        <translation>Mittel ± SD; rechte Spalte: {day}</translation>
    </message>
    <message>
        <source>Made with Carpus {version}</source>
        <translation>Erstellt mit Carpus {version}</translation>
    </message>
    <message>
        <source>measured with Carpus {versions}</source>
        <translation>gemessen mit Carpus {versions}</translation>
    </message>
    <message>
        <source>grey: repetitions; band: ± 1 SD of the angle</source>
        <translation>grau: Wiederholungen; Band: ± 1 SD des Winkels</translation>
    </message>
    <message>
        <source>marker positions within {size} mm</source>
        <translation>Markerpositionen auf {size} mm genau</translation>
    </message>
    <message>
        <source>live values, not smoothed</source>
        <translation>Live-Werte, nicht geglättet</translation>
    </message>
    <message>
        <source>repetition {number} excluded: {reason}</source>
        <translation>Nummer {number} ausgeschlossen: {reason}</translation>
    </message>
    <message>
        <source>as intended: the hand stays straight</source>
        <translation>wie vorgesehen: Hand bleibt in der Achse</translation>
    </message>
    <message>
        <source>No range of motion could be measured.</source>
        <translation>Kein Bewegungsausmaß messbar.</translation>
    </message>
    <message>
        <source>No active range of motion was measured.</source>
        <translation>Kein aktives Bewegungsausmaß gemessen.</translation>
    </message>
    <message>
        <source>Angles in the order deviation, flexion, pronation–supination; {zero}.</source>
        <translation>Winkel in der Reihenfolge Radial-/Ulnarduktion, Flexion, Pro-/Supination; {zero}.</translation>
    </message>
    <message>
        <source>Angles in the order of the ISB: flexion, deviation, pronation–supination; {zero}.</source>
        <translation>Winkel in der Reihenfolge der ISB: Flexion, Radial-/Ulnarduktion, Pro-/Supination; {zero}.</translation>
    </message>
    <message>
        <source>The wrist angles are in the order of the ISB (flexion first).</source>
        <translation>Die Winkel des Handgelenks stehen in der Reihenfolge der ISB (Flexion zuerst).</translation>
    </message>
    <message>
        <source>{depth} below the wrist marker (scatter {residual})</source>
        <translation>{depth} unter dem Handgelenkmarker (Streuung {residual})</translation>
    </message>
    <message>
        <source>Peak speed, mean ± SD</source>
        <translation>Maximalgeschwindigkeit, Mittel ± SD</translation>
    </message>
    <message>
        <source>Camera within tolerance: errors up to {angle}° and {length} mm (limits: {most_angle}° and {most_length} mm).</source>
        <translation>Kamera innerhalb der Toleranz: höchstens {angle}° und {length} mm Abweichung (Grenzen: {most_angle}° und {most_length} mm).</translation>
    </message>
    <message>
        <source>angles are wrong by {angle}°</source>
        <translation>Winkel weichen um {angle}° ab</translation>
    </message>
    <message>
        <source>Pauses during a movement, mean</source>
        <translation>Pausen während der Bewegung, Mittel</translation>
    </message>
    <message>
        <source>Largest flexion of each joint; ± is the SD between repetitions.</source>
        <translation>Größte Flexion jedes Gelenks; ± ist die SD zwischen den Wiederholungen.</translation>
    </message>
    <message>
        <source>Hand exercises at home</source>
        <translation>Handübungen für zu Hause</translation>
    </message>
    <message>
        <source>Tick the box of the day when you have done all its exercises.</source>
        <translation>Kreuzen Sie das Kästchen des Tages an, wenn alle Übungen geschafft sind.</translation>
    </message>
    <message>
        <source>Turn your palm up, then down. Keep your elbow at your side.</source>
        <translation>Die Handfläche nach oben drehen, dann nach unten. Der Ellbogen bleibt am Körper.</translation>
    </message>
    <message>
        <source>Notes and questions for your next appointment</source>
        <translation>Notizen und Fragen für den nächsten Termin</translation>
    </message>
    <message>
        <source>Movement in the other directions</source>
        <translation>Bewegung in den anderen Richtungen</translation>
    </message>
    <message>
        <source>Grades of finger motion</source>
        <translation>Bewertung der Fingerbeweglichkeit</translation>
    </message>
    <message>
        <source>Check the camera again: a check is due once a week.</source>
        <translation>Kamera erneut prüfen: Eine Prüfung ist einmal pro Woche fällig.</translation>
    </message>
    <message>
        <source>Saved for the camera with serial number {serial}. Values of earlier sessions do not change.</source>
        <translation>Gespeichert für die Kamera mit der Seriennummer {serial}. Die Werte früherer Sitzungen ändern sich nicht.</translation>
    </message>
    <message>
        <source>Positions: {count} of {all} fields ({least} needed)</source>
        <translation>Positionen: {count} von {all} Feldern ({least} nötig)</translation>
    </message>
    <message>
        <source>Show the board in other positions and at other tilts</source>
        <translation>Zeigen Sie die Tafel an anderen Positionen, mit anderer Neigung</translation>
    </message>
    <message>
        <source>Correction not kept for {names}. Correct a later frame too.</source>
        <translation>Korrektur nicht beibehalten: {names}. Korrigieren Sie auch ein späteres Bild.</translation>
    </message>
    <message>
        <source>Image taken. Move the board to another position.</source>
        <translation>Bild aufgenommen. Bewegen Sie die Tafel an eine andere Position.</translation>
    </message>
    <message>
        <source>Nothing was changed. Turn on depth registration in the camera settings.</source>
        <translation>Es wurde nichts geändert. Schalten Sie in den Kameraeinstellungen die Ausrichtung von Tiefe und Farbe ein.</translation>
    </message>
    <message>
        <source>too few images with depth values of the board</source>
        <translation>zu wenige Bilder mit Tiefenwerten auf der Tafel</translation>
    </message>
    <message>
        <source>mean of Carpus and reference · one point every 0.2 s, {count} points</source>
        <translation>Mittelwert von Carpus und Referenz · ein Punkt je 0,2 s, {count} Punkte</translation>
    </message>
    <message>
        <source>mean of Carpus and reference · one point per reading, {count} readings</source>
        <translation>Mittelwert von Carpus und Referenz · ein Punkt je Ablesung, {count} Ablesungen</translation>
    </message>
    <message>
        <source>Correlation of flexion, {one}–{other} (r)</source>
        <translation>Korrelation der Flexion, {one}–{other} (r)</translation>
    </message>
    <message>
        <source>Marker labels were corrected manually. The original result is kept.</source>
        <translation>Markerbezeichnungen wurden manuell korrigiert. Das ursprüngliche Ergebnis bleibt erhalten.</translation>
    </message>
    <message>
        <source>Measured manually, not by Carpus: {values}.</source>
        <translation>Manuell gemessen, nicht von Carpus: {values}.</translation>
    </message>
    <message>
        <source>each movement was shorter than 0.4 s</source>
        <translation>jede Bewegung war kürzer als 0,4 s</translation>
    </message>
    <message>
        <source>This clinic measured the MDC95 (measurement error) on {date} with {count} people. Where it was not measured, Carpus uses an expert default. The MDC applies to the same markers, side and set-up.</source>
        <translation>Die MDC95 (Messfehler) wurde am {date} im eigenen Haus mit {count} Personen gemessen. Wo sie nicht gemessen wurde, verwendet Carpus eine Expertenschätzung. Die MDC gilt nur bei denselben Markern, derselben Seite und demselben Aufbau.</translation>
    </message>
    <message>
        <source>Until the clinic has measured its own MDC (measurement error), Carpus uses an expert default, not a published value. For a total arc, which has two ends, the MDC is √2 times as large. It applies to the same markers, side and set-up.</source>
        <translation>Bis die Einrichtung ihre eigene MDC (Messfehler) gemessen hat, verwendet Carpus eine Expertenschätzung, keinen veröffentlichten Wert. Für ein Gesamtausmaß mit seinen zwei Endpunkten ist die MDC √2-mal so groß. Sie gilt nur bei denselben Markern, derselben Seite und demselben Aufbau.</translation>
    </message>
    <message>
        <source>{sign}: manual measurement of that day, active / passive. It is not combined with the other values.</source>
        <translation>{sign}: manuelle Messung an diesem Tag, aktiv / passiv. Sie wird nicht mit den anderen Werten verrechnet.</translation>
    </message>
    <message>
        <source>Check the camera once more, then calibrate it. If it is still out of tolerance, do not measure with it.</source>
        <translation>Die Kamera noch einmal prüfen, dann kalibrieren. Ist sie weiter außerhalb der Toleranz, nicht mit ihr messen.</translation>
    </message>
    <message>
        <source>{movement} {goal} (mean {mean}; beyond measurement error from {limit})</source>
        <translation>{movement} {goal} (Mittelwert {mean}; über dem Messfehler ab {limit})</translation>
    </message>
    <message>
        <source>all lengths are {share} % too long, by up to {length} mm</source>
        <translation>alle Längen sind {share} % zu groß, höchstens um {length} mm</translation>
    </message>
    <message>
        <source>all lengths are {share} % too short, by up to {length} mm</source>
        <translation>alle Längen sind {share} % zu klein, höchstens um {length} mm</translation>
    </message>
    <message>
        <source>{name}, mean ± SD</source>
        <translation>{name}, Mittel ± SD</translation>
    </message>
    <message>
        <source>Show speeds or angles</source>
        <translation>Geschwindigkeiten oder Winkel anzeigen</translation>
    </message>
    <message>
        <source>Percentage of the other hand’s TAM or, if not known, of the reference value of 260° (thumb 140°). ASSH: excellent from 100 %, good above 75 %, fair above 50 %, otherwise poor.</source>
        <translation>Prozent der TAM der anderen Hand oder, wenn sie nicht bekannt ist, des Referenzwerts von 260° (Daumen 140°). ASSH: sehr gut ab 100 %, gut über 75 %, mäßig über 50 %, sonst schlecht.</translation>
    </message>
    <message>
        <source>Check the camera again: it has been calibrated since the last check.</source>
        <translation>Kamera erneut prüfen: Seit der letzten Prüfung wurde sie kalibriert.</translation>
    </message>
    <message>
        <source>Tip to
palm, cm</source>
        <translation>FKHA
cm</translation>
    </message>
    <message>
        <source>{hand}, %</source>
        <translation>{hand}, %</translation>
    </message>
    <message>
        <source>Reference (age group)</source>
        <translation>Referenz (Altersgruppe)</translation>
    </message>
    <message>
        <source>65 to 85 years</source>
        <translation>65 bis 85 Jahre</translation>
    </message>
    <message>
        <source>Reference: {source}; {ages}, {sexes}.</source>
        <translation>Referenz: {source}; {ages}, {sexes}.</translation>
    </message>
    <message>
        <source>Walker 1984, 60 people (active, goniometer)</source>
        <translation>Walker 1984, 60 Personen (aktiv, Goniometer)</translation>
    </message>
    <message>
        <source>men</source>
        <translation>Männer</translation>
    </message>
    <message>
        <source>In the middle of the back of the wrist, in the small hollow.</source>
        <translation>Mitten auf dem Handgelenkrücken, im kleinen Grübchen.</translation>
    </message>
    <message>
        <source>Another blue spot fits the {markers} better than the clicked one.</source>
        <translation>{markers}: Eine andere blaue Stelle passt besser als die angeklickte.</translation>
    </message>
    <message>
        <source>Click the centre of the marker again, and keep the hand still.</source>
        <translation>Klicken Sie noch einmal in die Mitte des Markers, und halten Sie die Hand ruhig.</translation>
    </message>
    <message>
        <source>Click the centre of the {markers} again, or cover the other spot.</source>
        <translation>Klicken Sie noch einmal in die Mitte ({markers}), oder decken Sie die andere Stelle ab.</translation>
    </message>
    <message>
        <source>Cover the spot with the question mark, or give it the correct label.</source>
        <translation>Decken Sie die Stelle mit dem Fragezeichen ab, oder geben Sie ihr die richtige Bezeichnung.</translation>
    </message>
    <message>
        <source>The {markers} does not fit the other markers: no hand has this shape.</source>
        <translation>Der Marker „{markers}“ passt nicht zu den anderen: Keine Hand hat diese Form.</translation>
    </message>
    <message>
        <source>The camera is connected again: {subject} (disconnected for {detail}).</source>
        <translation>Die Kamera ist wieder verbunden: {subject} ({detail} getrennt).</translation>
    </message>
    <message>
        <source>The hand length is {value} mm (the limit is {limit} mm).</source>
        <translation>Die Handlänge beträgt {value} mm (Grenze: {limit} mm).</translation>
    </message>
    <message>
        <source>The hand length is {value} mm. Last time it was {limit} mm.</source>
        <translation>Die Handlänge beträgt {value} mm. Letztes Mal waren es {limit} mm.</translation>
    </message>
    <message>
        <source>The hand was still for only {value} frames ({limit} or more are good).</source>
        <translation>Die Hand war nur {value} Bilder lang ruhig ({limit} oder mehr sind gut).</translation>
    </message>
    <message>
        <source>The pseudonym {subject} belongs to another patient.</source>
        <translation>Das Pseudonym {subject} gehört zu einem anderen Patienten.</translation>
    </message>
    <message>
        <source>The labels seem to be shifted: the marker clicked as {first} is probably the {second}.</source>
        <translation>Die Bezeichnungen scheinen verschoben: Angeklickt ist „{first}“, der Marker ist aber wahrscheinlich „{second}“.</translation>
    </message>
    <message>
        <source>The Dask scheduler at {subject} does not respond ({detail}).</source>
        <translation>Der Dask-Scheduler unter {subject} antwortet nicht ({detail}).</translation>
    </message>
    <message>
        <source>This camera does not align depth with colour, so depths at the markers will be wrong.</source>
        <translation>Diese Kamera richtet Tiefe und Farbe nicht aufeinander aus, daher ist die Tiefe an den Markern falsch.</translation>
    </message>
    <message>
        <source>Unplug the camera, plug it in again, then restart the measurement.</source>
        <translation>Ziehen Sie die Kamera ab, schließen Sie sie wieder an, und starten Sie die Messung neu.</translation>
    </message>
    <message>
        <source>Use a C3D, TRC or MOT file, a CSV table with its column map, or a session.</source>
        <translation>Verwenden Sie eine C3D-, TRC- oder MOT-Datei, eine CSV-Tabelle mit ihrer Spaltenzuordnung oder eine Sitzung.</translation>
    </message>
    <message>
        <source>Use a camera with colour and depth, such as the Asus Xtion.</source>
        <translation>Verwenden Sie eine Kamera mit Farbe und Tiefe, zum Beispiel die Asus Xtion.</translation>
    </message>
    <message>
        <source>Use the marker set wrist6 or hand21.</source>
        <translation>Verwenden Sie den Markersatz wrist6 oder hand21.</translation>
    </message>
    <message>
        <source>damaged: a name in it is not text</source>
        <translation>beschädigt: ein Name darin ist kein Text</translation>
    </message>
    <message>
        <source>all six markers visible in {count} of {looked} frames</source>
        <translation>alle sechs Marker in {count} von {looked} Bildern sichtbar</translation>
    </message>
    <message>
        <source>{count} bytes after the end of the recording</source>
        <translation>{count} Bytes nach dem Ende der Aufnahme</translation>
    </message>
    <message>
        <source>damaged: the end cannot be read</source>
        <translation>beschädigt: Das Ende ist nicht lesbar</translation>
    </message>
    <message>
        <source>damaged: Carpus could not finish reading it</source>
        <translation>beschädigt: Carpus konnte das Lesen nicht abschließen</translation>
    </message>
    <message>
        <source>the focal length is uncertain by {share} %</source>
        <translation>die Brennweite ist um {share} % unsicher</translation>
    </message>
    <message>
        <source>this setting does not exist (file {file})</source>
        <translation>diese Einstellung gibt es nicht (Datei {file})</translation>
    </message>
    <message>
        <source>The labels of {markers} seem to be swapped.</source>
        <translation>Die Bezeichnungen scheinen vertauscht: {markers}.</translation>
    </message>
    <message>
        <source>damaged: the calibration in it does not describe a hand</source>
        <translation>beschädigt: Die Kalibrierung beschreibt keine Hand</translation>
    </message>
    <message>
        <source>A recording ended before its first second was saved, so it cannot be recovered: {subject}.</source>
        <translation>Eine Aufnahme endete, bevor ihre erste Sekunde gespeichert war, und kann nicht wiederhergestellt werden: {subject}.</translation>
    </message>
    <message>
        <source>A session that was saved on this computer is now in the session folder: {subject}.</source>
        <translation>Eine Sitzung, die auf diesem Computer gespeichert war, ist jetzt im Sitzungsordner: {subject}.</translation>
    </message>
    <message>
        <source>All sessions are safe. Your last entries may not be saved.</source>
        <translation>Alle Sitzungen sind sicher. Ihre letzten Eingaben sind vielleicht nicht gespeichert.</translation>
    </message>
    <message>
        <source>Back up to another disk now, and replace the faulty disk.</source>
        <translation>Sichern Sie die Daten jetzt auf einem anderen Datenträger, und ersetzen Sie den defekten.</translation>
    </message>
    <message>
        <source>Check that the reference shows the same movement, and state which column or marker is which.</source>
        <translation>Prüfen Sie, ob die Referenz dieselbe Bewegung zeigt, und geben Sie an, wofür jede Spalte und jeder Marker steht.</translation>
    </message>
    <message>
        <source>Check that the folder exists and that you are allowed to write to it, or choose another folder.</source>
        <translation>Prüfen Sie, ob der Ordner existiert und ob Sie dort schreiben dürfen, oder wählen Sie einen anderen.</translation>
    </message>
    <message>
        <source>Check the address of the scheduler.</source>
        <translation>Prüfen Sie die Adresse des Schedulers.</translation>
    </message>
    <message>
        <source>Close the other window or program, then try again.</source>
        <translation>Schließen Sie das andere Fenster oder Programm, und versuchen Sie es dann noch einmal.</translation>
    </message>
    <message>
        <source>Close other programs that use these files, then restart Carpus.</source>
        <translation>Schließen Sie andere Programme, die diese Dateien benutzen, und starten Sie Carpus neu.</translation>
    </message>
    <message>
        <source>Continue measuring. The gap is marked in the session.</source>
        <translation>Messen Sie weiter. Die Lücke ist in der Sitzung markiert.</translation>
    </message>
    <message>
        <source>Continue measuring. When the disk or network is available again, Carpus moves the session automatically.</source>
        <translation>Messen Sie weiter. Wenn Datenträger oder Netz wieder verfügbar sind, verschiebt Carpus die Sitzung automatisch.</translation>
    </message>
    <message>
        <source>Copy the recording again from its source, or correct its list of frames.</source>
        <translation>Kopieren Sie die Aufnahme noch einmal von ihrer Quelle, oder korrigieren Sie ihre Bildliste.</translation>
    </message>
    <message>
        <source>Everything saved before is safe. The data that Carpus was writing may be missing.</source>
        <translation>Alles vorher Gespeicherte ist sicher. Die Daten, die Carpus gerade schrieb, können fehlen.</translation>
    </message>
    <message>
        <source>Glue the board onto something stiff and flat, use good light, and hold the board still.</source>
        <translation>Kleben Sie die Tafel auf etwas Steifes und Ebenes, beleuchten Sie sie gut, und halten Sie sie ruhig.</translation>
    </message>
    <message>
        <source>To use another pseudonym, edit the patient.</source>
        <translation>Um ein anderes Pseudonym zu verwenden, bearbeiten Sie den Patienten.</translation>
    </message>
    <message>
        <source>If you copied the file, copy it again. Otherwise restore it from a backup.</source>
        <translation>Wenn Sie die Datei kopiert haben, kopieren Sie sie noch einmal. Sonst stellen Sie sie aus einer Sicherung wieder her.</translation>
    </message>
    <message>
        <source>If the units are wrong, correct the list of frames or state the unit of depth.</source>
        <translation>Wenn die Einheiten falsch sind, korrigieren Sie die Bildliste oder geben Sie die Einheit der Tiefe an.</translation>
    </message>
    <message>
        <source>The session can be opened, but its values may have been altered.</source>
        <translation>Die Sitzung kann geöffnet werden, aber ihre Werte können verändert sein.</translation>
    </message>
    <message>
        <source>The session is complete.</source>
        <translation>Die Sitzung ist vollständig.</translation>
    </message>
    <message>
        <source>{subject} does not state whether depth and colour are aligned. Carpus assumes that they are.</source>
        <translation>In {subject} ist nicht angegeben, ob Tiefe und Farbe deckungsgleich sind. Carpus geht davon aus, dass sie es sind.</translation>
    </message>
    <message>
        <source>The session is safe on this computer.</source>
        <translation>Die Sitzung ist auf diesem Computer sicher.</translation>
    </message>
    <message>
        <source>The SHA-256 checksum of the file does not match.</source>
        <translation>Die SHA-256-Prüfsumme der Datei stimmt nicht überein.</translation>
    </message>
    <message>
        <source>Measure a session, or choose the folder that contains the sessions.</source>
        <translation>Messen Sie eine Sitzung, oder wählen Sie den Ordner mit den Sitzungen.</translation>
    </message>
    <message>
        <source>You do not need to do anything.</source>
        <translation>Sie müssen nichts tun.</translation>
    </message>
    <message>
        <source>There is no camera calibration for {subject}, so lengths may be wrong by several per cent ({detail}).</source>
        <translation>Zu {subject} gibt es keine Kamerakalibrierung, daher können Längen um mehrere Prozent falsch sein ({detail}).</translation>
    </message>
    <message>
        <source>Nothing is lost. Names, images and values stay hidden.</source>
        <translation>Es ist nichts verloren. Namen, Bilder und Werte bleiben verborgen.</translation>
    </message>
    <message>
        <source>Open the record again and enter your change once more.</source>
        <translation>Öffnen Sie den Eintrag noch einmal, und geben Sie Ihre Änderung erneut ein.</translation>
    </message>
    <message>
        <source>Restart Carpus to recover what can still be read. If names are missing, restore a backup.</source>
        <translation>Starten Sie Carpus neu, um wiederherzustellen, was noch lesbar ist. Wenn Namen fehlen, stellen Sie eine Sicherung wieder her.</translation>
    </message>
    <message>
        <source>Restore these files from a backup.</source>
        <translation>Stellen Sie diese Dateien aus einer Sicherung wieder her.</translation>
    </message>
    <message>
        <source>Show the board in all parts of the image, tilted to all four sides, near and far. Hold it still.</source>
        <translation>Zeigen Sie die Tafel überall im Bild, nach allen vier Seiten geneigt, nah und fern. Halten Sie sie ruhig.</translation>
    </message>
    <message>
        <source>Some images are smaller than the others and were enlarged: {subject} ({detail}).</source>
        <translation>Einige Bilder sind kleiner als die anderen und wurden vergrößert: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>State in the camera file whether depth and colour are aligned.</source>
        <translation>Geben Sie in der Kameradatei an, ob Tiefe und Farbe deckungsgleich sind.</translation>
    </message>
    <message>
        <source>The backup is incomplete: {subject} is missing or cannot be read ({detail} in total).</source>
        <translation>Die Sicherung ist unvollständig: {subject} fehlt oder kann nicht gelesen werden (insgesamt {detail}).</translation>
    </message>
    <message>
        <source>The backup failed verification: a file in it differs from the original ({subject}, {detail}).</source>
        <translation>Die Prüfung der Sicherung ist fehlgeschlagen: Eine Datei darin weicht vom Original ab ({subject}, {detail}).</translation>
    </message>
    <message>
        <source>The clinic’s server does not respond: {subject} ({detail}).</source>
        <translation>Der Server der Einrichtung antwortet nicht: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The patient list was created by another version of Carpus: {subject} ({detail}).</source>
        <translation>Die Patientenliste stammt von einer anderen Version von Carpus: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The reference contains nothing that can be compared: {subject} ({detail}).</source>
        <translation>Die Referenz enthält nichts Vergleichbares: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The session folder contains no Carpus data: {subject}.</source>
        <translation>Der Sitzungsordner enthält keine Daten von Carpus: {subject}.</translation>
    </message>
    <message>
        <source>There is no camera type with the name {subject} ({detail}).</source>
        <translation>Es gibt keinen Kameratyp namens {subject} ({detail}).</translation>
    </message>
    <message>
        <source>There is no marker set with the name {subject} ({detail}).</source>
        <translation>Es gibt keinen Markersatz namens {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The files are no longer listed. Carpus tries to delete them again at each start.</source>
        <translation>Die Dateien erscheinen in keiner Liste mehr. Carpus versucht bei jedem Start noch einmal, sie zu löschen.</translation>
    </message>
    <message>
        <source>These files were not changed. All other sessions are safe.</source>
        <translation>Diese Dateien wurden nicht verändert. Alle anderen Sitzungen sind sicher.</translation>
    </message>
    <message>
        <source>This text cannot be used as a name: {detail} ({subject}).</source>
        <translation>Dieser Text kann kein Name sein: {detail} ({subject}).</translation>
    </message>
    <message>
        <source>Two patients had the pseudonym {subject}. The second one now has ({detail}) after it.</source>
        <translation>Zwei Patienten hatten das Pseudonym {subject}. Beim zweiten steht jetzt ({detail}) dahinter.</translation>
    </message>
    <message>
        <source>Restore the session from a backup.</source>
        <translation>Stellen Sie die Sitzung aus einer Sicherung wieder her.</translation>
    </message>
    <message>
        <source>Wait until the other program has finished, or choose another folder.</source>
        <translation>Warten Sie, bis das andere Programm fertig ist, oder wählen Sie einen anderen Ordner.</translation>
    </message>
    <message>
        <source>Wait until the recording has ended, or restart Carpus to complete the session.</source>
        <translation>Warten Sie, bis die Aufnahme beendet ist, oder starten Sie Carpus neu, damit es die Sitzung abschließt.</translation>
    </message>
    <message>
        <source>Everything recorded is safe.</source>
        <translation>Alles Aufgenommene ist sicher.</translation>
    </message>
    <message>
        <source>Without the option --scheduler, this computer tracks the recordings.</source>
        <translation>Ohne die Option --scheduler wertet dieser Computer die Aufnahmen aus.</translation>
    </message>
    <message>
        <source>You can use the live values of this session.</source>
        <translation>Sie können die Live-Werte dieser Sitzung verwenden.</translation>
    </message>
    <message>
        <source>The unit of depth is depth_unit_m in camera_info.yaml.</source>
        <translation>Die Einheit der Tiefe steht als depth_unit_m in camera_info.yaml.</translation>
    </message>
    <message>
        <source>“carpus calibrate-camera --board” writes the board as a PDF to print.</source>
        <translation>„carpus calibrate-camera --board“ schreibt die Tafel als PDF zum Drucken.</translation>
    </message>
    <message>
        <source>“carpus recover” also completes the session.</source>
        <translation>„carpus recover“ schließt die Sitzung ebenfalls ab.</translation>
    </message>
    <message>
        <source>not a valid TOML file: too many nested tables</source>
        <translation>keine gültige TOML-Datei: zu viele verschachtelte Tabellen</translation>
    </message>
    <message>
        <source>on; Carpus corrects it</source>
        <translation>an, von Carpus korrigiert</translation>
    </message>
    <message>
        <source>You can also track the recording again with “carpus track”.</source>
        <translation>Sie können die Aufnahme auch mit „carpus track“ neu analysieren.</translation>
    </message>
    <message>
        <source>Continue measuring. If the server still does not respond, ask your IT support.</source>
        <translation>Messen Sie weiter. Wenn der Server weiter nicht antwortet, fragen Sie Ihre IT-Betreuung.</translation>
    </message>
    <message>
        <source>Lay the card flat under the camera, fully in view, about 60 cm away, in good light.</source>
        <translation>Legen Sie die Karte flach unter die Kamera, ganz im Bild, etwa 60 cm entfernt, bei gutem Licht.</translation>
    </message>
    <message>
        <source>“carpus doctor” shows which data folder is used.</source>
        <translation>„carpus doctor“ zeigt, welcher Datenordner verwendet wird.</translation>
    </message>
    <message>
        <source>You can also put the file camera_info.yaml of the camera next to the recording.</source>
        <translation>Sie können auch die Datei camera_info.yaml der Kamera neben die Aufnahme legen.</translation>
    </message>
    <message>
        <source>The MDC values were not changed.</source>
        <translation>Die MDC-Werte wurden nicht geändert.</translation>
    </message>
    <message>
        <source>The recording has unusual units, and Carpus converts them: {subject} ({detail}).</source>
        <translation>Die Aufnahme hat ungewöhnliche Einheiten, und Carpus rechnet sie um: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>damaged: reading it needs too much memory</source>
        <translation>beschädigt: Das Lesen braucht zu viel Speicher</translation>
    </message>
    <message>
        <source>Session files are safe. Do not delete the patient list: no other file has the names and notes.</source>
        <translation>Die Sitzungsdateien sind sicher. Löschen Sie die Patientenliste nicht: Namen und Notizen stehen nur dort.</translation>
    </message>
    <message>
        <source>These sessions cannot be used as a test–retest study: {subject} ({detail}).</source>
        <translation>Diese Sitzungen lassen sich nicht als Test-Retest-Studie verwenden: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Thumb contact occluded</source>
        <translation>Daumenkontakt verdeckt</translation>
    </message>
    <message>
        <source>Touched {met} of {all} fingertips</source>
        <translation>{met} von {all} Fingerspitzen berührt</translation>
    </message>
    <message>
        <source>total arcs in the same period</source>
        <translation>Gesamtausmaße im selben Zeitraum</translation>
    </message>
    <message>
        <source>Duration</source>
        <translation>Dauer</translation>
    </message>
    <message>
        <source>{weeks} before this session</source>
        <translation>{weeks} vor dieser Sitzung</translation>
    </message>
    <message>
        <source>{difference} since first session</source>
        <translation>{difference} seit erster Sitzung</translation>
    </message>
    <message>
        <source>Start Carpus from a desktop session. The commands for files work without a screen.</source>
        <translation>Starten Sie Carpus auf einer grafischen Oberfläche. Die Befehle für Dateien funktionieren auch ohne Bildschirm.</translation>
    </message>
    <message>
        <source>hand is {json}, but right or left is expected</source>
        <translation>hand ist {json}, erwartet ist right oder left</translation>
    </message>
    <message>
        <source>side of the wedge with one marker</source>
        <translation>Keilseite mit einem Marker</translation>
    </message>
    <message>
        <source>session and reference overlap by less than {least_overlap_s} s, or nothing moves</source>
        <translation>Sitzung und Referenz überschneiden sich um weniger als {least_overlap_s} s, oder es gibt keine Bewegung</translation>
    </message>
    <message>
        <source>line {number} names a file outside the folder: {content}</source>
        <translation>Zeile {number} nennt eine Datei außerhalb des Ordners: {content}</translation>
    </message>
    <message>
        <source>straight_fingers must be five values, true or false, from thumb to little finger</source>
        <translation>straight_fingers muss aus fünf Werten true oder false bestehen, vom Daumen bis zum Kleinfinger</translation>
    </message>
    <message>
        <source>the best match of the curves is only {match}. Check that they show the same movement</source>
        <translation>die beste Übereinstimmung der Kurven ist nur {match}. Prüfen Sie, ob sie dieselbe Bewegung zeigen</translation>
    </message>
    <message>
        <source>session and reference do not overlap in time</source>
        <translation>Sitzung und Referenz überschneiden sich zeitlich nicht</translation>
    </message>
    <message>
        <source>side of the wedge with two markers</source>
        <translation>Keilseite mit zwei Markern</translation>
    </message>
    <message>
        <source>{folder}: cannot write to {there}</source>
        <translation>{folder}: in {there} lässt sich nicht schreiben</translation>
    </message>
    <message>
        <source>{name} is {json}, but two pixel coordinates are expected</source>
        <translation>{name} ist {json}, erwartet sind zwei Pixelkoordinaten</translation>
    </message>
    <message>
        <source>Analysing…</source>
        <translation>Wird ausgewertet …</translation>
    </message>
    <message>
        <source>Analysing: {seconds} s left</source>
        <translation>Auswertung: noch {seconds} s</translation>
    </message>
    <message>
        <source>the markers of session and reference are {apart} mm apart (expected: up to {most} mm). They may be other markers or another hand, or the markers may jump</source>
        <translation>die Marker von Sitzung und Referenz liegen {apart} mm auseinander (erwartet: bis zu {most} mm). Vielleicht sind es andere Marker oder eine andere Hand, oder die Marker springen</translation>
    </message>
    <message>
        <source>Send the patient again from the clinic software, or choose the patient in Carpus.</source>
        <translation>Übergeben Sie den Patienten erneut aus der Praxissoftware, oder wählen Sie ihn in Carpus.</translation>
    </message>
    <message>
        <source>The file from the clinic software cannot be read: {subject} ({detail}).</source>
        <translation>Die Datei der Praxissoftware kann nicht gelesen werden: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Time since</source>
        <translation>Seit</translation>
    </message>
    <message>
        <source>The cup may occlude the thumb. The results show for how long.</source>
        <translation>Der Becher kann den Daumen verdecken. Die Ergebnisse zeigen, wie lange.</translation>
    </message>
    <message>
        <source>Any movement of the forearm is included in the angle.</source>
        <translation>Jede Bewegung des Unterarms verändert den Winkel.</translation>
    </message>
    <message>
        <source>Status</source>
        <translation>Status</translation>
    </message>
    <message>
        <source>see the next page for the complete list</source>
        <translation>vollständige Liste auf der nächsten Seite</translation>
    </message>
    <message>
        <source>Proposed from the last session:</source>
        <translation>Vorschlag aus der letzten Sitzung:</translation>
    </message>
    <message>
        <source>Proposed from the last {count} sessions:</source>
        <translation>Vorschlag aus den letzten {count} Sitzungen:</translation>
    </message>
    <message>
        <source>up to 54 years</source>
        <translation>bis 54 Jahre</translation>
    </message>
    <message>
        <source>fingertip to palm {distance}</source>
        <translation>Fingerkuppen-Hohlhand-Abstand {distance}</translation>
    </message>
    <message>
        <source>There. Hold still.</source>
        <translation>Geschafft. Stillhalten.</translation>
    </message>
    <message>
        <source>TAM is missing for fingers whose joints were never all visible at once.</source>
        <translation>Die TAM fehlt bei Fingern, deren Gelenke nie alle zugleich sichtbar waren.</translation>
    </message>
    <message>
        <source>Hand at the edge of the table. Cup 5 to 7 cm wide, 20 to 30 cm away.</source>
        <translation>Hand an der Tischkante. Becher mit 5 bis 7 cm Durchmesser in 20 bis 30 cm Abstand.</translation>
    </message>
    <message>
        <source>Choose a patient in the list, then start here. The practice patient is simulated.</source>
        <translation>Wählen Sie einen Patienten in der Liste, und beginnen Sie dann hier. Der Testpatient ist simuliert.</translation>
    </message>
    <message>
        <source>Every marker has its label and all checks are good. Start measuring here.</source>
        <translation>Jeder Marker hat seine Bezeichnung, und alle Prüfungen sind gut. Starten Sie die Messung hier.</translation>
    </message>
    <message>
        <source>You have finished a whole session. The arrow at the top left leads back to the patients.</source>
        <translation>Sie haben eine ganze Sitzung abgeschlossen. Der Pfeil oben links führt zurück zu den Patienten.</translation>
    </message>
    <message>
        <source>The camera needs a USB 2 port: some USB 3 ports refuse cameras with old firmware.</source>
        <translation>Die Kamera braucht einen USB-2-Anschluss: Manche USB-3-Anschlüsse lehnen Kameras mit alter Firmware ab.</translation>
    </message>
    <message>
        <source>This camera sends no time stamps. Carpus uses the time at which each frame arrives, so speeds are approximate.</source>
        <translation>Diese Kamera sendet keine Zeitstempel. Carpus verwendet die Ankunftszeit der Bilder, daher sind Geschwindigkeiten nur Näherungen.</translation>
    </message>
    <message>
        <source>unknown file format {value}</source>
        <translation>unbekanntes Dateiformat {value}</translation>
    </message>
    <message>
        <source>{movement}: the session has no range in this direction, and the list of readings has no time</source>
        <translation>{movement}: Die Sitzung hat in dieser Richtung kein Bewegungsausmaß, und die Liste der Ablesungen nennt keine Zeit</translation>
    </message>
    <message>
        <source>The backup contains every session.</source>
        <translation>Die Sicherung enthält alle Sitzungen.</translation>
    </message>
    <message>
        <source>1 session file is missing from the backup.</source>
        <translation>In der Sicherung fehlt 1 Sitzungsdatei.</translation>
    </message>
    <message>
        <source>{n} session files are missing from the backup.</source>
        <translation>In der Sicherung fehlen {n} Sitzungsdateien.</translation>
    </message>
    <message>
        <source>The backup is on the same disk as the data. If that disk fails, both are lost.</source>
        <translation>Die Sicherung liegt auf demselben Datenträger wie die Daten. Fällt er aus, ist beides verloren.</translation>
    </message>
    <message>
        <source>You may feel a stretch, but no pain. If your hand still hurts an hour later, do less next time and call us.</source>
        <translation>Es darf ziehen, aber nicht wehtun. Tut die Hand nach einer Stunde noch weh, machen Sie das nächste Mal weniger und rufen Sie uns an.</translation>
    </message>
    <message>
        <source>the saved data differ from the recorded data</source>
        <translation>die gespeicherten Daten weichen von den aufgenommenen ab</translation>
    </message>
    <message>
        <source>“carpus track --leave-out-damaged” continues without the damaged frames.</source>
        <translation>„carpus track --leave-out-damaged“ arbeitet ohne die beschädigten Bilder weiter.</translation>
    </message>
    <message>
        <source>Carpus changed nothing there.</source>
        <translation>Carpus hat dort nichts geändert.</translation>
    </message>
    <message>
        <source>Reinstall OpenNI2.</source>
        <translation>Installieren Sie OpenNI2 neu.</translation>
    </message>
    <message>
        <source>Check that every label is on its marker, then press Enter.</source>
        <translation>Prüfen, ob jede Bezeichnung auf ihrem Marker liegt, dann Eingabe drücken.</translation>
    </message>
    <message>
        <source>Boone and Azen 1979, 109 males from 18 months on (active, goniometer)</source>
        <translation>Boone und Azen 1979, 109 männliche Personen ab 18 Monaten (aktiv, Goniometer)</translation>
    </message>
    <message>
        <source>Undo the last change of a repetition</source>
        <translation>Letzte Änderung einer Wiederholung rückgängig machen</translation>
    </message>
    <message>
        <source>start or end set manually: repetition {numbers}</source>
        <translation>Anfang oder Ende manuell gesetzt: Wiederholung {numbers}</translation>
    </message>
</context>
<context>
    <name>AppointmentBox</name>
    <message>
        <source>No appointment yet</source>
        <translation>Noch kein Termin</translation>
    </message>
    <message>
        <source>Next appointment: day, month, year</source>
        <translation>Nächster Termin: Tag, Monat, Jahr</translation>
    </message>
    <message>
        <source>Next appointment: this day has passed</source>
        <translation>Nächster Termin: Das Datum liegt in der Vergangenheit</translation>
    </message>
</context>
<context>
    <name>BackupCard</name>
    <message>
        <source>&amp;Back up now</source>
        <translation>Jetzt &amp;sichern</translation>
    </message>
    <message>
        <source>&amp;Restore…</source>
        <translation>&amp;Wiederherstellen…</translation>
    </message>
    <message>
        <source>Change…</source>
        <translation>Ändern…</translation>
    </message>
    <message>
        <source>Backup</source>
        <translation>Sicherung</translation>
    </message>
    <message>
        <source>Daily at 12:00</source>
        <translation>Um 12:00</translation>
    </message>
    <message>
        <source>Daily at 18:00</source>
        <translation>Um 18:00</translation>
    </message>
    <message>
        <source>Manual only</source>
        <translation>Nur manuell</translation>
    </message>
    <message>
        <source>Backup folder</source>
        <translation>Ordner</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Aufbewahren</translation>
    </message>
    <message>
        <source>Anyone with the backup disk can read it. Use an encrypted disk.</source>
        <translation>Wer den Datenträger hat, kann die Sicherungen lesen. Verwenden Sie einen verschlüsselten Datenträger.</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keiner</translation>
    </message>
    <message>
        <source>{percent} %</source>
        <translation>{percent} %</translation>
    </message>
    <message>
        <source>Backs up the whole data folder: patients, sessions, images and log. You can continue measuring.</source>
        <translation>Sichert den ganzen Datenordner: Patienten, Sitzungen, Bilder und Protokoll. Sie können dabei messen.</translation>
    </message>
    <message>
        <source>The backup is verified afterwards.</source>
        <translation>Die Sicherung wird danach geprüft.</translation>
    </message>
    <message>
        <source>The changes are shown first.</source>
        <translation>Die Änderungen werden zuerst gezeigt.</translation>
    </message>
    <message>
        <source>the last 14 backups, plus one per month for 2 years</source>
        <translation>die letzten 14 Sicherungen, dazu 2 Jahre lang eine pro Monat</translation>
    </message>
    <message>
        <source>Automatic backup</source>
        <translation>Automatisch</translation>
    </message>
</context>
<context>
    <name>BackupController</name>
    <message>
        <source>Connect the backup disk and back up.</source>
        <translation>Schließen Sie den Sicherungsdatenträger an, und erstellen Sie eine Sicherung.</translation>
    </message>
    <message>
        <source>Open settings</source>
        <translation>Einstellungen öffnen</translation>
    </message>
    <message>
        <source>Backup folder, on another disk</source>
        <translation>Ordner für Sicherungen, auf anderem Datenträger</translation>
    </message>
    <message>
        <source>Folder with the backups</source>
        <translation>Ordner mit den Sicherungen</translation>
    </message>
    <message>
        <source>{when}: {n} session files</source>
        <translation>{when}: {n} Sitzungsdateien</translation>
    </message>
    <message>
        <source>Which backup should be restored?</source>
        <translation>Welche Sicherung soll wiederhergestellt werden?</translation>
    </message>
    <message>
        <source>Carpus shows the changes before it restores anything.</source>
        <translation>Carpus zeigt die Änderungen, bevor es etwas wiederherstellt.</translation>
    </message>
    <message>
        <source>Restore the backup of {when}? Session files added: {come}, changed: {change}, removed: {go}.</source>
        <translation>Sicherung vom {when} wiederherstellen? Sitzungsdateien hinzugefügt: {come}, geändert: {change}, entfernt: {go}.</translation>
    </message>
    <message>
        <source>Patients and sessions deleted since then stay deleted: {n}.</source>
        <translation>Seitdem gelöschte Patienten und Sitzungen bleiben gelöscht: {n}.</translation>
    </message>
    <message>
        <source>The current data folder is kept next to the restored one.</source>
        <translation>Der jetzige Datenordner bleibt neben dem wiederhergestellten erhalten.</translation>
    </message>
    <message>
        <source>Carpus closes afterwards. Start it again then.</source>
        <translation>Carpus wird danach geschlossen. Starten Sie es dann neu.</translation>
    </message>
    <message>
        <source>Restore</source>
        <translation>Wiederherstellen</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Restore…</source>
        <translation>Wiederherstellen…</translation>
    </message>
</context>
<context>
    <name>BoardCaptureView</name>
    <message>
        <source>Stop</source>
        <translation>Stopp</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Progress</source>
        <translation>Fortschritt</translation>
    </message>
    <message>
        <source>Images are taken automatically when the board is still, sharp and in a new position.</source>
        <translation>Bilder werden automatisch aufgenommen, wenn die Tafel ruhig, scharf und an einer neuen Position ist.</translation>
    </message>
    <message>
        <source>Opening the camera…</source>
        <translation>Kamera wird geöffnet…</translation>
    </message>
    <message>
        <source>Please wait</source>
        <translation>Bitte warten</translation>
    </message>
    <message>
        <source>No image yet</source>
        <translation>Noch kein Bild</translation>
    </message>
    <message>
        <source>Hold the board in view</source>
        <translation>Halten Sie die Tafel ins Bild</translation>
    </message>
    <message>
        <source>Show the whole board, facing the camera, about 60 cm away.</source>
        <translation>Zeigen Sie die ganze Tafel, der Kamera zugewandt, in etwa 60 cm Abstand.</translation>
    </message>
    <message>
        <source>No frames from the camera</source>
        <translation>Keine Bilder von der Kamera</translation>
    </message>
    <message>
        <source>Enough images</source>
        <translation>Genug Bilder</translation>
    </message>
    <message>
        <source>Press “Calculate”, or add more images to improve the result.</source>
        <translation>Drücken Sie „Berechnen“, oder verbessern Sie das Ergebnis mit weiteren Bildern.</translation>
    </message>
    <message>
        <source>Then hold it still.</source>
        <translation>Dann ruhig halten.</translation>
    </message>
    <message>
        <source>1 image</source>
        <translation>1 Bild</translation>
    </message>
    <message>
        <source>{count} images</source>
        <translation>{count} Bilder</translation>
    </message>
    <message>
        <source>Calculating…</source>
        <translation>Berechnung läuft…</translation>
    </message>
    <message>
        <source>This takes a few seconds. You can put the board down.</source>
        <translation>Das dauert einige Sekunden. Sie können die Tafel ablegen.</translation>
    </message>
</context>
<context>
    <name>BoardResultView</name>
    <message>
        <source>&amp;Repeat</source>
        <translation>&amp;Wiederholen</translation>
    </message>
    <message>
        <source>Use this calibration</source>
        <translation>Diese Kalibrierung verwenden</translation>
    </message>
</context>
<context>
    <name>BoardSetupView</name>
    <message>
        <source>&amp;Print the board…</source>
        <translation>Tafel &amp;drucken…</translation>
    </message>
    <message>
        <source>Length of the printed ruler</source>
        <translation>Länge des gedruckten Lineals</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Starten</translation>
    </message>
    <message>
        <source>Calibrate the camera</source>
        <translation>Kamera kalibrieren</translation>
    </message>
    <message>
        <source>1  Print the board</source>
        <translation>1  Tafel drucken</translation>
    </message>
    <message>
        <source>Use even light without reflections. The screen shows where to hold the board. Images are taken automatically when it is still, sharp and in a new position. No image is saved, and nothing changes until you confirm.</source>
        <translation>Sorgen Sie für gleichmäßiges Licht ohne Spiegelungen. Der Bildschirm zeigt, wohin die Tafel gehört. Bilder werden automatisch aufgenommen, wenn sie ruhig, scharf und an einer neuen Position ist. Es wird kein Bild gespeichert, und nichts ändert sich, bevor Sie bestätigen.</translation>
    </message>
    <message>
        <source>The camera is connected.</source>
        <translation>Die Kamera ist angeschlossen.</translation>
    </message>
    <message>
        <source>No camera is connected.</source>
        <translation>Keine Kamera ist angeschlossen.</translation>
    </message>
    <message>
        <source>Start · connect the camera</source>
        <translation>Starten · Kamera anschließen</translation>
    </message>
    <message>
        <source>2  Show it to the camera</source>
        <translation>2  Tafel der Kamera zeigen</translation>
    </message>
    <message>
        <source>Calibration takes five minutes. It measures the lens, the depth error and the alignment of depth and colour. Do it once for each camera, and again if the camera was knocked or is out of tolerance.</source>
        <translation>Die Kalibrierung dauert fünf Minuten. Sie vermisst das Objektiv, den Tiefenfehler und die Ausrichtung von Tiefe und Farbe. Führen Sie sie einmal je Kamera durch, und erneut, wenn die Kamera angestoßen wurde oder außerhalb der Toleranz ist.</translation>
    </message>
    <message>
        <source>Print at 100 % (“actual size”) on plain paper. Glue the print flat onto something stiff, such as glass or thick cardboard. Then measure the printed ruler.</source>
        <translation>Drucken Sie mit 100 % („Originalgröße“) auf normales Papier. Kleben Sie den Ausdruck flach auf etwas Steifes, etwa Glas oder dicken Karton. Messen Sie dann das gedruckte Lineal.</translation>
    </message>
</context>
<context>
    <name>BubbleView</name>
    <message>
        <source>&amp;Next</source>
        <translation>&amp;Weiter</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>First session · {number} of {count}</source>
        <translation>Erste Sitzung · {number} von {count}</translation>
    </message>
    <message>
        <source>First session</source>
        <translation>Erste Sitzung</translation>
    </message>
    <message>
        <source>&amp;Done</source>
        <translation>&amp;Fertig</translation>
    </message>
    <message>
        <source>End the tour</source>
        <translation>Rundgang beenden</translation>
    </message>
</context>
<context>
    <name>CameraCalibrationFlow</name>
    <message>
        <source>Camera calibration</source>
        <translation>Kamerakalibrierung</translation>
    </message>
    <message>
        <source>Save the board to print</source>
        <translation>Tafel zum Drucken speichern</translation>
    </message>
    <message>
        <source>Add more images with the board closer and more tilted: {why}.</source>
        <translation>Nehmen Sie weitere Bilder auf, mit der Tafel näher und stärker geneigt: {why}.</translation>
    </message>
</context>
<context>
    <name>CameraCard</name>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Chec&amp;k card…</source>
        <translation>Prüf&amp;karte…</translation>
    </message>
    <message>
        <source>Cali&amp;brate the camera…</source>
        <translation>Kamera kali&amp;brieren…</translation>
    </message>
    <message>
        <source>In the demo the camera is simulated. It needs no calibration.</source>
        <translation>In der Demo ist die Kamera simuliert. Sie braucht keine Kalibrierung.</translation>
    </message>
    <message>
        <source>A printed board calibrates the camera. A printed card checks in 30 seconds whether the camera is still within tolerance.</source>
        <translation>Mit einer gedruckten Tafel wird die Kamera kalibriert. Eine gedruckte Karte prüft in 30 Sekunden, ob die Kamera noch innerhalb der Toleranz misst.</translation>
    </message>
</context>
<context>
    <name>CameraFlow</name>
    <message>
        <source>The camera is being opened.</source>
        <translation>Die Kamera wird geöffnet.</translation>
    </message>
    <message>
        <source>The recording is being opened.</source>
        <translation>Die Aufnahme wird geöffnet.</translation>
    </message>
    <message>
        <source>Choose the source again</source>
        <translation>Quelle neu wählen</translation>
    </message>
    <message>
        <source>The simulated patient is being prepared.</source>
        <translation>Der simulierte Patient wird vorbereitet.</translation>
    </message>
</context>
<context>
    <name>CameraNameDialog</name>
    <message>
        <source>Camera name</source>
        <translation>Kameraname</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Is this still the camera “{name}”?</source>
        <translation>Ist das noch die Kamera „{name}“?</translation>
    </message>
    <message>
        <source>What is this camera called?</source>
        <translation>Wie heißt diese Kamera?</translation>
    </message>
    <message>
        <source>This camera has no readable serial number. If it is a different one, enter its name: calibrations and checks are saved under that name.</source>
        <translation>Diese Kamera meldet keine Seriennummer. Ist es eine andere, geben Sie deren Namen ein: Kalibrierungen und Prüfungen werden unter diesem Namen gespeichert.</translation>
    </message>
    <message>
        <source>This camera has no readable serial number. Name it and label it: calibrations and checks are saved under that name. Carpus treats every camera of this type without a number as this one.</source>
        <translation>Diese Kamera meldet keine Seriennummer. Benennen und beschriften Sie sie: Kalibrierungen und Prüfungen werden unter diesem Namen gespeichert. Carpus behandelt jede Kamera dieses Typs ohne Nummer als diese.</translation>
    </message>
</context>
<context>
    <name>CameraScreen</name>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Simulated camera</source>
        <translation>Simulierte Kamera</translation>
    </message>
    <message>
        <source>Choose a &amp;file…</source>
        <translation>&amp;Datei wählen…</translation>
    </message>
    <message>
        <source>Choose a fol&amp;der…</source>
        <translation>&amp;Ordner wählen…</translation>
    </message>
    <message>
        <source>Progress</source>
        <translation>Fortschritt</translation>
    </message>
    <message>
        <source>Which image source?</source>
        <translation>Welche Bildquelle?</translation>
    </message>
    <message>
        <source>Before you continue</source>
        <translation>Bevor es weitergeht</translation>
    </message>
    <message>
        <source>Camera above the hand, 60 cm or more away, looking straight down. No sun on the markers.</source>
        <translation>Kamera über der Hand, 60 cm oder mehr entfernt, Blick senkrecht nach unten. Keine Sonne auf den Markern.</translation>
    </message>
    <message>
        <source>The depth camera over the hand.</source>
        <translation>Die Tiefenkamera über der Hand.</translation>
    </message>
    <message>
        <source>Camera ready</source>
        <translation>Kamera bereit</translation>
    </message>
    <message>
        <source>No camera</source>
        <translation>Keine Kamera</translation>
    </message>
    <message>
        <source>Open the camera</source>
        <translation>Kamera öffnen</translation>
    </message>
    <message>
        <source>Open the recording</source>
        <translation>Aufnahme öffnen</translation>
    </message>
    <message>
        <source>Start the simulation</source>
        <translation>Simulation starten</translation>
    </message>
    <message>
        <source>No camera yet</source>
        <translation>Noch keine Kamera</translation>
    </message>
    <message>
        <source>Choose a recording first</source>
        <translation>Erst eine Aufnahme wählen</translation>
    </message>
    <message>
        <source>Opening…</source>
        <translation>Wird geöffnet…</translation>
    </message>
    <message>
        <source>Recordings ({patterns});;All files (*)</source>
        <translation>Aufnahmen ({patterns});;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Choose a recording</source>
        <translation>Aufnahme wählen</translation>
    </message>
    <message>
        <source>A saved recording: a file of Carpus or of the camera (.oni, .db3), or an image folder.</source>
        <translation>Eine gespeicherte Aufnahme: eine Datei von Carpus oder der Kamera (.oni, .db3) oder ein Bilderordner.</translation>
    </message>
    <message>
        <source>Plug it directly into the computer.</source>
        <translation>Schließen Sie die Kamera direkt am Computer an.</translation>
    </message>
    <message>
        <source>Choose an image folder</source>
        <translation>Bilderordner wählen</translation>
    </message>
    <message>
        <source>A simulated hand does the exercise, so that you can try Carpus. The session is marked as simulated.</source>
        <translation>Zum Ausprobieren führt eine simulierte Hand die Übung aus. Die Sitzung ist als simuliert gekennzeichnet.</translation>
    </message>
</context>
<context>
    <name>CheckCardFlow</name>
    <message>
        <source>Check card</source>
        <translation>Prüfkarte</translation>
    </message>
    <message>
        <source>Save the card to print</source>
        <translation>Karte zum Drucken speichern</translation>
    </message>
</context>
<context>
    <name>CheckCardScreen</name>
    <message>
        <source>Print &amp;card…</source>
        <translation>Karte &amp;drucken…</translation>
    </message>
    <message>
        <source>Cali&amp;brate the camera…</source>
        <translation>Kamera kali&amp;brieren…</translation>
    </message>
    <message>
        <source>Progress of the check</source>
        <translation>Fortschritt der Prüfung</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Stopp</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Print both pages at 100 %: each ruler must be 100 mm long. Glue the first page flat onto stiff card. Fold the wedge and glue it onto the dashed field.</source>
        <translation>Drucken Sie beide Seiten mit 100 %: Jedes Lineal muss 100 mm lang sein. Kleben Sie die erste Seite flach auf steifen Karton. Falten Sie den Keil, und kleben Sie ihn auf das gestrichelte Feld.</translation>
    </message>
    <message>
        <source>Check now, 30 seconds</source>
        <translation>Jetzt prüfen, 30 Sekunden</translation>
    </message>
    <message>
        <source>Check · connect the camera</source>
        <translation>Prüfen · Kamera anschließen</translation>
    </message>
    <message>
        <source>Within tolerance</source>
        <translation>Innerhalb der Toleranz</translation>
    </message>
    <message>
        <source>Check again</source>
        <translation>Erneut prüfen</translation>
    </message>
    <message>
        <source>Out of tolerance</source>
        <translation>Außerhalb der Toleranz</translation>
    </message>
    <message>
        <source>Opening the camera…</source>
        <translation>Kamera wird geöffnet…</translation>
    </message>
    <message>
        <source>{seconds} s</source>
        <translation>{seconds} s</translation>
    </message>
    <message>
        <source>Not checked yet</source>
        <translation>Noch nicht geprüft</translation>
    </message>
    <message>
        <source>A check is valid for one week. If all lengths are wrong by the same percentage, the depth or the print size is wrong.</source>
        <translation>Eine Prüfung gilt eine Woche. Weichen alle Längen um denselben Prozentsatz ab, stimmt die Tiefe oder die Druckgröße nicht.</translation>
    </message>
</context>
<context>
    <name>CheckRow</name>
    <message>
        <source>good</source>
        <translation>gut</translation>
    </message>
    <message>
        <source>to check</source>
        <translation>zu prüfen</translation>
    </message>
    <message>
        <source>missing</source>
        <translation>fehlt</translation>
    </message>
</context>
<context>
    <name>ChoiceDialog</name>
    <message>
        <source>Choice</source>
        <translation>Auswahl</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
</context>
<context>
    <name>ComparisonFlow</name>
    <message>
        <source>Simulated data: no patient was measured. Excluded from analysis.</source>
        <translation>Simulierte Daten: keine Messung an einem Patienten. Von der Auswertung ausgeschlossen.</translation>
    </message>
</context>
<context>
    <name>ComparisonScreen</name>
    <message>
        <source>Reading both sessions…</source>
        <translation>Beide Sitzungen werden gelesen…</translation>
    </message>
    <message>
        <source>Reading the session…</source>
        <translation>Sitzung wird gelesen…</translation>
    </message>
    <message>
        <source>Repetition {number}</source>
        <translation>Wdh. {number}</translation>
    </message>
    <message>
        <source>repetition</source>
        <translation>Wiederholung</translation>
    </message>
    <message>
        <source>Differences</source>
        <translation>Unterschiede</translation>
    </message>
    <message>
        <source>The sessions cannot be compared, because one of them could not be read.</source>
        <translation>Die Sitzungen lassen sich nicht vergleichen, weil eine nicht gelesen werden konnte.</translation>
    </message>
</context>
<context>
    <name>CorrectionFrameView</name>
    <message>
        <source>Frame with labels to correct</source>
        <translation>Bild mit Bezeichnungen zum Korrigieren</translation>
    </message>
    <message>
        <source>{marker}, before</source>
        <translation>{marker}, bisher</translation>
    </message>
    <message>
        <source>{marker}, occluded</source>
        <translation>{marker}, verdeckt</translation>
    </message>
    <message>
        <source>{marker}?</source>
        <translation>{marker}?</translation>
    </message>
</context>
<context>
    <name>CorrectionScreen</name>
    <message>
        <source>Next uncertain frame</source>
        <translation>Nächstes unsicheres Bild</translation>
    </message>
    <message>
        <source>Not visible here</source>
        <translation>Hier nicht sichtbar</translation>
    </message>
    <message>
        <source>Re-analyse from here</source>
        <translation>Ab hier neu analysieren</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Back to the review (Esc)</source>
        <translation>Zurück zur Auswertung (Esc)</translation>
    </message>
    <message>
        <source>Distance to the expected position</source>
        <translation>Abstand zur erwarteten Position</translation>
    </message>
    <message>
        <source>Reading the frame…</source>
        <translation>Bild wird gelesen…</translation>
    </message>
    <message>
        <source>Uncertain at {time}</source>
        <translation>Unsicher bei {time}</translation>
    </message>
    <message>
        <source>Frame at {time}</source>
        <translation>Bild bei {time}</translation>
    </message>
    <message>
        <source>Which label is wrong?</source>
        <translation>Welche Bezeichnung ist falsch?</translation>
    </message>
    <message>
        <source>Drag a label in the frame, or select it below and click its marker.</source>
        <translation>Ziehen Sie eine Bezeichnung im Bild, oder wählen Sie sie unten und klicken Sie ihren Marker an.</translation>
    </message>
    <message>
        <source>No video was saved. These are the {count} blue spots of this frame. Drag a label to its spot.</source>
        <translation>Es wurde kein Video gespeichert. Dies sind die {count} blauen Stellen dieses Bildes. Ziehen Sie eine Bezeichnung auf ihre Stelle.</translation>
    </message>
    <message>
        <source>Re-analyse from {time}</source>
        <translation>Neu analysieren ab {time}</translation>
    </message>
    <message>
        <source>Nothing corrected yet</source>
        <translation>Noch nichts korrigiert</translation>
    </message>
    <message>
        <source>Changed here: {markers}</source>
        <translation>Hier geändert: {markers}</translation>
    </message>
    <message>
        <source>Drag the label “{marker}” to its marker</source>
        <translation>Ziehen Sie „{marker}“ auf den richtigen Marker</translation>
    </message>
</context>
<context>
    <name>CourseRunner</name>
    <message>
        <source>Exercise set “{name}”, {number} of {count}: {part}</source>
        <translation>Übungsfolge „{name}“, {number} von {count}: {part}</translation>
    </message>
    <message>
        <source>Rest {time}. Press Space to start now.</source>
        <translation>Pause {time}. Leertaste: sofort beginnen.</translation>
    </message>
</context>
<context>
    <name>DateField</name>
    <message>
        <source>day month year</source>
        <translation>Tag Monat Jahr</translation>
    </message>
    <message>
        <source>The date is in the future</source>
        <translation>Das Datum liegt in der Zukunft</translation>
    </message>
    <message>
        <source>This date does not exist</source>
        <translation>Dieses Datum gibt es nicht</translation>
    </message>
    <message>
        <source>Day, month, year</source>
        <translation>Tag, Monat, Jahr</translation>
    </message>
</context>
<context>
    <name>DegreesField</name>
    <message>
        <source>Up to {most}°, or empty</source>
        <translation>Bis {most}°, oder leer</translation>
    </message>
</context>
<context>
    <name>DeleteDialog</name>
    <message>
        <source>Delete permanently</source>
        <translation>Endgültig löschen</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Archive instead</source>
        <translation>Lieber archivieren</translation>
    </message>
    <message>
        <source>Deleted</source>
        <translation>Wird gelöscht</translation>
    </message>
    <message>
        <source>Not deleted</source>
        <translation>Wird nicht gelöscht</translation>
    </message>
    <message>
        <source>Cannot be undone</source>
        <translation>Nicht rückgängig zu machen</translation>
    </message>
    <message>
        <source>Delete this session permanently?</source>
        <translation>Diese Sitzung endgültig löschen?</translation>
    </message>
    <message>
        <source>Delete this patient permanently?</source>
        <translation>Diesen Patienten endgültig löschen?</translation>
    </message>
    <message>
        <source>To delete, type “{name}” here</source>
        <translation>Zum Löschen geben Sie hier „{name}“ ein</translation>
    </message>
    <message>
        <source>Angles, images, notes and pain scores of this session ({size} MB, files: {files}).</source>
        <translation>Winkel, Bilder, Notizen und Schmerzwerte dieser Sitzung ({size} MB, Dateien: {files}).</translation>
    </message>
    <message>
        <source>Backups up to {day} and copies elsewhere.</source>
        <translation>Sicherungen bis {day} und Kopien an anderen Orten.</translation>
    </message>
    <message>
        <source>Copies elsewhere.</source>
        <translation>Kopien an anderen Orten.</translation>
    </message>
    <message>
        <source>The log records the deletion, without a name.</source>
        <translation>Das Protokoll verzeichnet die Löschung, ohne Namen.</translation>
    </message>
    <message>
        <source>The retention period set in Settings ({years} years) ends on {day}. You would delete before that date.</source>
        <translation>Die eingestellte Aufbewahrungsfrist ({years} Jahre) endet am {day}. Sie würden vor diesem Datum löschen.</translation>
    </message>
    <message>
        <source>The patient’s other sessions.</source>
        <translation>Die anderen Sitzungen des Patienten.</translation>
    </message>
    <message>
        <source>The patient’s entry: real name, notes, manual measurements. All sessions ({count}): angles, images, notes ({size} MB, files: {files}).</source>
        <translation>Der Eintrag des Patienten: echter Name, Notizen, manuelle Messungen. Alle Sitzungen ({count}): Winkel, Bilder, Notizen ({size} MB, Dateien: {files}).</translation>
    </message>
    <message>
        <source>Archiving removes it from all lists and results. Everything can be restored.</source>
        <translation>Archivieren entfernt alles aus Listen und Ergebnissen. Alles lässt sich wiederherstellen.</translation>
    </message>
    <message>
        <source>Delete reports and exports saved elsewhere yourself ({n}): {path}.</source>
        <translation>Bitte selbst löschen: anderswo gespeicherte Berichte und Exporte ({n}): {path}.</translation>
    </message>
    <message>
        <source>Check these files outside the patient’s folder yourself ({n}): {path}.</source>
        <translation>Bitte selbst prüfen: Dateien außerhalb des Patientenordners ({n}): {path}.</translation>
    </message>
    <message>
        <source>Deleted data cannot be restored.</source>
        <translation>Gelöschte Daten lassen sich nicht wiederherstellen.</translation>
    </message>
    <message>
        <source>Deleted data cannot be restored, not even from a backup.</source>
        <translation>Gelöschte Daten lassen sich nicht wiederherstellen, auch nicht aus einer Sicherung.</translation>
    </message>
</context>
<context>
    <name>DeletionController</name>
    <message>
        <source>The session of {day} is in the archive.</source>
        <translation>Die Sitzung vom {day} ist im Archiv.</translation>
    </message>
    <message>
        <source>{name} is in the archive.</source>
        <translation>{name} ist im Archiv.</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Rückgängig</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>The session was deleted.</source>
        <translation>Die Sitzung wurde gelöscht.</translation>
    </message>
    <message>
        <source>The patient was deleted.</source>
        <translation>Der Patient wurde gelöscht.</translation>
    </message>
    <message>
        <source>Files deleted: {count}.</source>
        <translation>Gelöschte Dateien: {count}.</translation>
    </message>
    <message>
        <source>The session now belongs to {name}.</source>
        <translation>Die Sitzung gehört jetzt zu {name}.</translation>
    </message>
    <message>
        <source>Nothing was deleted. Archived items are excluded until restored.</source>
        <translation>Es wurde nichts gelöscht. Archiviertes ist ausgeschlossen, bis es wiederhergestellt wird.</translation>
    </message>
</context>
<context>
    <name>Dialog</name>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Your entries are not saved yet. Press Esc again to close without saving.</source>
        <translation>Ihre Eingaben sind noch nicht gespeichert. Noch einmal Esc schließt ohne Speichern.</translation>
    </message>
</context>
<context>
    <name>ExcludeDialog</name>
    <message>
        <source>Exclude this session?</source>
        <translation>Diese Sitzung ausschließen?</translation>
    </message>
    <message>
        <source>wrong exercise</source>
        <translation>falsche Übung</translation>
    </message>
    <message>
        <source>Exclude</source>
        <translation>Ausschließen</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>pain</source>
        <translation>Schmerz</translation>
    </message>
    <message>
        <source>markers lost</source>
        <translation>Marker nicht erfasst</translation>
    </message>
    <message>
        <source>Another reason</source>
        <translation>Anderer Grund</translation>
    </message>
    <message>
        <source>The session stays in the list and can be opened, but is excluded from analysis. You can include it again.</source>
        <translation>Die Sitzung bleibt in der Liste und lässt sich öffnen, wird aber nicht ausgewertet. Sie können sie wieder einschließen.</translation>
    </message>
    <message>
        <source>practice run</source>
        <translation>Probedurchgang</translation>
    </message>
</context>
<context>
    <name>ExclusionDialog</name>
    <message>
        <source>pain</source>
        <translation>Schmerz</translation>
    </message>
    <message>
        <source>Passive (moved by the therapist): analysed separately from active repetitions.</source>
        <translation>Passiv (von Therapeutin oder Therapeut bewegt): getrennt von den aktiven Wiederholungen ausgewertet.</translation>
    </message>
    <message>
        <source>Passive</source>
        <translation>Passiv</translation>
    </message>
    <message>
        <source>other movement</source>
        <translation>andere Bewegung</translation>
    </message>
    <message>
        <source>Another reason</source>
        <translation>Anderer Grund</translation>
    </message>
    <message>
        <source>Keep included</source>
        <translation>Nicht ausschließen</translation>
    </message>
    <message>
        <source>Is repetition {number} passive or excluded?</source>
        <translation>Wiederholung {number}: als passiv werten oder ausschließen?</translation>
    </message>
    <message>
        <source>Exclude</source>
        <translation>Ausschließen</translation>
    </message>
    <message>
        <source>Passive from here on</source>
        <translation>Passiv ab hier</translation>
    </message>
    <message>
        <source>Excluded from the results, but still shown on the curves and mentioned in the report.</source>
        <translation>Aus den Ergebnissen ausgeschlossen, aber weiter in den Kurven gezeigt und im Bericht erwähnt.</translation>
    </message>
    <message>
        <source>practice run</source>
        <translation>Probedurchgang</translation>
    </message>
</context>
<context>
    <name>ExerciseScreen</name>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>no goal</source>
        <translation>kein Ziel</translation>
    </message>
    <message>
        <source>Use as goals</source>
        <translation>Als Ziele verwenden</translation>
    </message>
    <message>
        <source>Inferred</source>
        <translation>Abgeleitet</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message>
        <source>DIP joints of the fingers</source>
        <translation>DIP-Gelenke der Finger</translation>
    </message>
    <message>
        <source>Adult</source>
        <translation>Erwachsene</translation>
    </message>
    <message>
        <source>Child</source>
        <translation>Kinder</translation>
    </message>
    <message>
        <source>No</source>
        <translation>Nein</translation>
    </message>
    <message>
        <source>Yes</source>
        <translation>Ja</translation>
    </message>
    <message>
        <source>Which exercise?</source>
        <translation>Welche Übung?</translation>
    </message>
    <message>
        <source>Hand to measure</source>
        <translation>Zu messende Hand</translation>
    </message>
    <message>
        <source>Repetitions</source>
        <translation>Wiederholungen</translation>
    </message>
    <message>
        <source>The patient’s view is for</source>
        <translation>Die Patientenansicht ist für</translation>
    </message>
    <message>
        <source>Also save video</source>
        <translation>Auch Video speichern</translation>
    </message>
    <message>
        <source>Goal, {movement}</source>
        <translation>Ziel, {movement}</translation>
    </message>
    <message>
        <source>Which hand is measured?</source>
        <translation>Welche Hand wird gemessen?</translation>
    </message>
    <message>
        <source>Exercise sets…</source>
        <translation>Übungsfolgen…</translation>
    </message>
    <message>
        <source>This recording</source>
        <translation>Diese Aufnahme</translation>
    </message>
    <message>
        <source>Needed to see and correct markers later. Uses {size} MB per minute; space for {time}.</source>
        <translation>Nötig, um Marker später zu sehen und zu korrigieren. Braucht {size} MB je Minute; Platz für {time}.</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Weiter</translation>
    </message>
</context>
<context>
    <name>ExportController</name>
    <message>
        <source>Export to folder</source>
        <translation>In Ordner exportieren</translation>
    </message>
</context>
<context>
    <name>ExportDialog</name>
    <message>
        <source>Tables (CSV): angles, joints, markers, events, values</source>
        <translation>Tabellen (CSV): Winkel, Gelenke, Marker, Ereignisse, Werte</translation>
    </message>
    <message>
        <source>Values with their origin (JSON)</source>
        <translation>Werte mit ihrer Herkunft (JSON)</translation>
    </message>
    <message>
        <source>Markers for motion capture programs (C3D)</source>
        <translation>Marker für Programme der Bewegungsanalyse (C3D)</translation>
    </message>
    <message>
        <source>Markers for OpenSim (TRC)</source>
        <translation>Marker für OpenSim (TRC)</translation>
    </message>
    <message>
        <source>Angles for OpenSim (MOT)</source>
        <translation>Winkel für OpenSim (MOT)</translation>
    </message>
    <message>
        <source>Data set for research (BIDS-Motion)</source>
        <translation>Datensatz für die Forschung (BIDS-Motion)</translation>
    </message>
    <message>
        <source>Session file, for another Carpus installation</source>
        <translation>Sitzungsdatei, für eine andere Carpus-Installation</translation>
    </message>
    <message>
        <source>Existing files are never overwritten.</source>
        <translation>Vorhandene Dateien werden nie überschrieben.</translation>
    </message>
    <message>
        <source>Tables of angles, repetitions and values (CSV), for any spreadsheet.</source>
        <translation>Tabellen der Winkel, Wiederholungen und Werte (CSV), für jede Tabellenkalkulation.</translation>
    </message>
    <message>
        <source>Export this session</source>
        <translation>Diese Sitzung exportieren</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Stopp</translation>
    </message>
    <message>
        <source>&amp;Tables for</source>
        <translation>&amp;Tabellen für</translation>
    </message>
    <message>
        <source>De-identified: random name, relative days, no notes</source>
        <translation>Ohne Personendaten: Zufallsname, Tageszählung statt Datum, keine Notizen</translation>
    </message>
    <message>
        <source>Progress of the export</source>
        <translation>Fortschritt des Exports</translation>
    </message>
    <message>
        <source>Choose folder…</source>
        <translation>Ordner wählen…</translation>
    </message>
    <message>
        <source>&amp;Other formats…</source>
        <translation>&amp;Weitere Formate…</translation>
    </message>
    <message>
        <source>For JSON, C3D, TRC, MOT and BIDS, turn on “For research” in the settings.</source>
        <translation>Für JSON, C3D, TRC, MOT und BIDS schalten Sie „Für die Forschung“ in den Einstellungen ein.</translation>
    </message>
    <message>
        <source>other programs: 1.5, separated by commas</source>
        <translation>andere Programme: 1.5, durch Kommas getrennt</translation>
    </message>
    <message>
        <source>a spreadsheet in {region}: {example}</source>
        <translation>eine Tabellenkalkulation in {region}: {example}</translation>
    </message>
    <message>
        <source>Values for a hospital system (FHIR R4)</source>
        <translation>Werte für ein Krankenhaussystem (FHIR R4)</translation>
    </message>
</context>
<context>
    <name>FaultDetails</name>
    <message>
        <source>Details</source>
        <translation>Details</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>Kopieren</translation>
    </message>
</context>
<context>
    <name>FingerCurves</name>
    <message>
        <source>Joint angles of the last ten seconds, by finger</source>
        <translation>Gelenkwinkel der letzten zehn Sekunden, je Finger</translation>
    </message>
    <message>
        <source>Last 10 s</source>
        <translation>Letzte 10 s</translation>
    </message>
    <message>
        <source>Flexion</source>
        <translation>Flexion</translation>
    </message>
    <message>
        <source>Abduction</source>
        <translation>Abduktion</translation>
    </message>
    <message>
        <source>inferred from PIP</source>
        <translation>vom PIP abgeleitet</translation>
    </message>
    <message>
        <source>inferred</source>
        <translation>abgeleitet</translation>
    </message>
</context>
<context>
    <name>FingerGrid</name>
    <message>
        <source>Finger joints, goniometer</source>
        <translation>Fingergelenke, Goniometer</translation>
    </message>
    <message>
        <source>Measured by Carpus on this day</source>
        <translation>Von Carpus an diesem Tag gemessen</translation>
    </message>
</context>
<context>
    <name>FrameView</name>
    <message>
        <source>Camera image</source>
        <translation>Kamerabild</translation>
    </message>
</context>
<context>
    <name>GuidancePanel</name>
    <message>
        <source>Lay the hand flat and still</source>
        <translation>Legen Sie die Hand flach und ruhig hin</translation>
    </message>
    <message>
        <source>Checks</source>
        <translation>Prüfungen</translation>
    </message>
    <message>
        <source>Marker {number} of {asked}</source>
        <translation>Marker {number} von {asked}</translation>
    </message>
    <message>
        <source>All markers found</source>
        <translation>Alle Marker gefunden</translation>
    </message>
    <message>
        <source>Checking the markers…</source>
        <translation>Marker werden geprüft…</translation>
    </message>
    <message>
        <source>Start measuring · {left}</source>
        <translation>Messung starten · {left}</translation>
    </message>
    <message>
        <source>No blue marker in the image</source>
        <translation>Kein blauer Marker im Bild</translation>
    </message>
    <message>
        <source>No blue marker is visible</source>
        <translation>Kein blauer Marker sichtbar</translation>
    </message>
    <message>
        <source>No markers found. Check that they are on the hand, the hand is in view and the light is good.</source>
        <translation>Keine Marker gefunden. Prüfen Sie, ob die Marker auf der Hand sind, ob die Hand im Bild ist und ob das Licht gut ist.</translation>
    </message>
    <message>
        <source>Looking for the markers…</source>
        <translation>Marker werden gesucht…</translation>
    </message>
    <message>
        <source>Ready to measure</source>
        <translation>Bereit zum Messen</translation>
    </message>
    <message>
        <source>Start measuring</source>
        <translation>Messung starten</translation>
    </message>
    <message>
        <source>Swap the two</source>
        <translation>Beide tauschen</translation>
    </message>
    <message>
        <source>Click the marker again</source>
        <translation>Marker neu anklicken</translation>
    </message>
    <message>
        <source>Correct labels</source>
        <translation>Korrigieren</translation>
    </message>
    <message>
        <source>Use that spot</source>
        <translation>Diese Stelle verwenden</translation>
    </message>
    <message>
        <source>New image</source>
        <translation>Neues Bild</translation>
    </message>
    <message>
        <source>Start anyway (&amp;uncertain)</source>
        <translation>Trotzdem &amp;starten</translation>
    </message>
    <message>
        <source>Image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>Palm down, fingers as straight as possible, forearm in line. Then take the image.</source>
        <translation>Handfläche nach unten, Finger möglichst gestreckt, Unterarm in einer Linie mit der Hand. Nehmen Sie dann das Bild auf.</translation>
    </message>
    <message>
        <source>Take the image</source>
        <translation>Bild aufnehmen</translation>
    </message>
    <message>
        <source>Hold the hand in this position until measuring begins.</source>
        <translation>Halten Sie die Hand in dieser Stellung, bis die Messung beginnt.</translation>
    </message>
    <message>
        <source>Click the markers</source>
        <translation>Marker anklicken</translation>
    </message>
    <message>
        <source>1 marker left to click</source>
        <translation>noch 1 Marker</translation>
    </message>
    <message>
        <source>{count} markers left to click</source>
        <translation>noch {count} Marker</translation>
    </message>
</context>
<context>
    <name>HandDrawing</name>
    <message>
        <source>Hand from above</source>
        <translation>Hand von oben</translation>
    </message>
    <message>
        <source>Right hand,
from above</source>
        <translation>Rechte Hand,
von oben</translation>
    </message>
    <message>
        <source>Left hand,
from above</source>
        <translation>Linke Hand,
von oben</translation>
    </message>
</context>
<context>
    <name>HandImageDialog</name>
    <message>
        <source>Image of the hand</source>
        <translation>Bild der Hand</translation>
    </message>
    <message>
        <source>Carpus cannot protect the saved file: anyone who has it can open it. The export is logged.</source>
        <translation>Carpus kann die gespeicherte Datei nicht schützen: Wer sie hat, kann sie öffnen. Der Export wird protokolliert.</translation>
    </message>
    <message>
        <source>The hand is not visible here, or its marker labels are uncertain. Choose another moment.</source>
        <translation>Die Hand ist hier nicht sichtbar, oder die Bezeichnungen ihrer Marker sind unsicher. Wählen Sie einen anderen Moment.</translation>
    </message>
    <message>
        <source>The patient has agreed</source>
        <translation>Der Patient hat zugestimmt</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Speichern…</translation>
    </message>
    <message>
        <source>The image shows only the hand and its angle. Face, room and name are removed. If the hand does not move in the image plane, the angle is only written, not drawn.</source>
        <translation>Das Bild zeigt nur die Hand und ihren Winkel. Gesicht, Raum und Name sind entfernt. Bewegt sich die Hand nicht in der Bildebene, wird der Winkel nur angegeben, nicht gezeichnet.</translation>
    </message>
</context>
<context>
    <name>HelpScreen</name>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Keys</source>
        <translation>Tasten</translation>
    </message>
    <message>
        <source>Guide</source>
        <translation>Anleitung</translation>
    </message>
    <message>
        <source>Save the cards</source>
        <translation>Karten speichern</translation>
    </message>
    <message>
        <source>Print cards…</source>
        <translation>Karten drucken…</translation>
    </message>
    <message>
        <source>&amp;Guide me through a first session</source>
        <translation>Durch eine erste Sitzung &amp;führen</translation>
    </message>
</context>
<context>
    <name>HomeDialog</name>
    <message>
        <source>Home exercise sheet</source>
        <translation>Übungsblatt für zu Hause</translation>
    </message>
    <message>
        <source>One page for the patient, without values or diagnosis. Up to {count} exercises.</source>
        <translation>Eine Seite für den Patienten, ohne Werte und Diagnose. Bis zu {count} Übungen.</translation>
    </message>
    <message>
        <source>Ne&amp;xt appointment</source>
        <translation>Nächster &amp;Termin</translation>
    </message>
    <message>
        <source>T&amp;ime</source>
        <translation>&amp;Uhrzeit</translation>
    </message>
    <message>
        <source>Language of the patient</source>
        <translation>Sprache des Patienten</translation>
    </message>
    <message>
        <source>Show the sheet</source>
        <translation>Blatt anzeigen</translation>
    </message>
    <message>
        <source>Time: {count} characters too long</source>
        <translation>Uhrzeit: {count} Zeichen zu viel</translation>
    </message>
    <message>
        <source>&amp;Repetitions</source>
        <translation>&amp;Wiederholungen</translation>
    </message>
    <message>
        <source>Times a &amp;day</source>
        <translation>Wie oft am Ta&amp;g</translation>
    </message>
    <message>
        <source>&amp;Message to the patient (no names)</source>
        <translation>&amp;Mitteilung an den Patienten (keine Namen)</translation>
    </message>
    <message>
        <source>Message: {count} characters too long</source>
        <translation>Mitteilung: {count} Zeichen zu viel</translation>
    </message>
</context>
<context>
    <name>LetterDialog</name>
    <message>
        <source>Letter to the doctor</source>
        <translation>Arztbrief</translation>
    </message>
    <message>
        <source>One page with the values of this session and your comment. Addresses stay in your list.</source>
        <translation>Eine Seite mit den Werten dieser Sitzung und Ihrem Kommentar. Anschriften bleiben in Ihrer Liste.</translation>
    </message>
    <message>
        <source>Name and address, up to {count} lines</source>
        <translation>Name und Anschrift, bis zu {count} Zeilen</translation>
    </message>
    <message>
        <source>Language of the letter</source>
        <translation>Sprache des Briefs</translation>
    </message>
    <message>
        <source>Print the patient’s real name</source>
        <translation>Echten Namen drucken</translation>
    </message>
    <message>
        <source>Show the letter</source>
        <translation>Brief anzeigen</translation>
    </message>
    <message>
        <source>Previous recipients</source>
        <translation>Bisherige Empfänger</translation>
    </message>
    <message>
        <source>The name appears in this letter only. Anyone who has the file can read it.</source>
        <translation>Der Name steht nur in diesem Brief. Wer die Datei hat, kann ihn lesen.</translation>
    </message>
</context>
<context>
    <name>LicencesWindow</name>
    <message>
        <source>Components and licences</source>
        <translation>Komponenten und Lizenzen</translation>
    </message>
    <message>
        <source>The licences are legal texts and are shown in their original language.</source>
        <translation>Die Lizenzen sind Rechtstexte und stehen in ihrer Originalsprache.</translation>
    </message>
</context>
<context>
    <name>LiveCurves</name>
    <message>
        <source>Curves of the last ten seconds</source>
        <translation>Kurven der letzten zehn Sekunden</translation>
    </message>
    <message>
        <source>no value</source>
        <translation>kein Wert</translation>
    </message>
    <message>
        <source>10 s ago</source>
        <translation>vor 10 s</translation>
    </message>
    <message>
        <source>now</source>
        <translation>jetzt</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Geschwindigkeit</translation>
    </message>
    <message>
        <source>Rotation</source>
        <translation>Rotation</translation>
    </message>
</context>
<context>
    <name>LiveFlow</name>
    <message>
        <source>Recording paused automatically at {time}.</source>
        <translation>Die Aufnahme wurde um {time} automatisch angehalten.</translation>
    </message>
    <message>
        <source>Stop and review</source>
        <translation>Beenden und auswerten</translation>
    </message>
    <message>
        <source>Choose another source</source>
        <translation>Andere Quelle wählen</translation>
    </message>
    <message>
        <source>To the patients</source>
        <translation>Zu den Patienten</translation>
    </message>
    <message>
        <source>Continue measuring</source>
        <translation>Weiter messen</translation>
    </message>
    <message>
        <source>The recording has only just begun.</source>
        <translation>Die Aufnahme hat gerade erst begonnen.</translation>
    </message>
    <message>
        <source>Continue measuring or stop now?</source>
        <translation>Weiter messen oder jetzt beenden?</translation>
    </message>
    <message>
        <source>Stop recording?</source>
        <translation>Aufnahme beenden?</translation>
    </message>
    <message>
        <source>Continue measuring, or stop: the session is saved and opens in the review.</source>
        <translation>Weiter messen oder beenden: Die Sitzung wird gespeichert und öffnet sich in der Auswertung.</translation>
    </message>
    <message>
        <source>Stop, save and close</source>
        <translation>Beenden, speichern, schließen</translation>
    </message>
    <message>
        <source>A recording is running.</source>
        <translation>Eine Aufnahme läuft.</translation>
    </message>
    <message>
        <source>Everything measured so far is saved, whatever you choose.</source>
        <translation>Alles bisher Gemessene wird gespeichert, was Sie auch wählen.</translation>
    </message>
    <message>
        <source>Continue measuring, or stop: the session is saved and Carpus closes.</source>
        <translation>Messen Sie weiter, oder beenden Sie: Die Sitzung wird gespeichert, und Carpus wird geschlossen.</translation>
    </message>
    <message>
        <source>{time} and {count} full repetitions are saved.</source>
        <translation>{time} und {count} vollständige Wiederholungen sind gespeichert.</translation>
    </message>
    <message>
        <source>Recording continues while you choose. Everything is saved.</source>
        <translation>Die Aufnahme läuft weiter, während Sie wählen. Alles wird gespeichert.</translation>
    </message>
</context>
<context>
    <name>LiveScreen</name>
    <message>
        <source>Patient’s view</source>
        <translation>Patientenansicht</translation>
    </message>
    <message>
        <source>The recording plays from its first frame</source>
        <translation>Die Aufnahme wird ab dem ersten Bild abgespielt</translation>
    </message>
    <message>
        <source>Waiting for the camera image</source>
        <translation>Warten auf das Kamerabild</translation>
    </message>
    <message>
        <source>No image</source>
        <translation>Kein Bild</translation>
    </message>
    <message>
        <source>Plug the camera in again</source>
        <translation>Schließen Sie die Kamera wieder an</translation>
    </message>
    <message>
        <source>Recording can start in a moment</source>
        <translation>Die Aufnahme kann gleich beginnen</translation>
    </message>
    <message>
        <source>Starts in {seconds}</source>
        <translation>Beginn in {seconds}</translation>
    </message>
    <message>
        <source>Starts automatically when the hand is still</source>
        <translation>Beginnt automatisch, wenn die Hand ruhig liegt</translation>
    </message>
    <message>
        <source>Close the patient’s view</source>
        <translation>Patientenansicht schließen</translation>
    </message>
    <message>
        <source>Open the patient’s view</source>
        <translation>Patientenansicht öffnen</translation>
    </message>
    <message>
        <source>Angles</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>Speeds</source>
        <translation>Geschwindigkeit</translation>
    </message>
    <message>
        <source>Preparing the simulated hand</source>
        <translation>Simulierte Hand wird vorbereitet</translation>
    </message>
    <message>
        <source>Progress of the analysis</source>
        <translation>Fortschritt der Auswertung</translation>
    </message>
</context>
<context>
    <name>LockCard</name>
    <message>
        <source>Lock</source>
        <translation>Sperre</translation>
    </message>
    <message>
        <source>A PIN only hides the screen. It does not encrypt files.</source>
        <translation>Eine PIN verbirgt nur den Bildschirm. Sie verschlüsselt keine Dateien.</translation>
    </message>
    <message>
        <source>After 5 min</source>
        <translation>Nach 5 min</translation>
    </message>
    <message>
        <source>After 10 min</source>
        <translation>Nach 10 min</translation>
    </message>
    <message>
        <source>Never</source>
        <translation>Nie</translation>
    </message>
    <message>
        <source>Lock automatically</source>
        <translation>Automatisch sperren</translation>
    </message>
    <message>
        <source>PIN</source>
        <translation>PIN</translation>
    </message>
    <message>
        <source>Change PIN…</source>
        <translation>PIN ändern…</translation>
    </message>
    <message>
        <source>Set a PIN…</source>
        <translation>PIN festlegen…</translation>
    </message>
    <message>
        <source>After 30 min</source>
        <translation>Nach 30 min</translation>
    </message>
    <message>
        <source>lock now</source>
        <translation>jetzt sperren</translation>
    </message>
</context>
<context>
    <name>LockController</name>
    <message>
        <source>The current PIN is wrong.</source>
        <translation>Die aktuelle PIN ist falsch.</translation>
    </message>
    <message>
        <source>Too many attempts. Try again in {seconds} s.</source>
        <translation>Zu viele Versuche. Erneut versuchen in {seconds} s.</translation>
    </message>
</context>
<context>
    <name>LockScreen</name>
    <message>
        <source>Locked</source>
        <translation>Gesperrt</translation>
    </message>
    <message>
        <source>PIN</source>
        <translation>PIN</translation>
    </message>
    <message>
        <source>Unlock</source>
        <translation>Entsperren</translation>
    </message>
    <message>
        <source>All data are saved, including the open session.</source>
        <translation>Alle Daten sind gespeichert, auch die offene Sitzung.</translation>
    </message>
    <message>
        <source>All data are saved.</source>
        <translation>Alle Daten sind gespeichert.</translation>
    </message>
    <message>
        <source>Names, images and values are hidden.</source>
        <translation>Namen, Bilder und Werte sind verborgen.</translation>
    </message>
    <message>
        <source>Locked automatically at {time} after {minutes} minutes without input.</source>
        <translation>Um {time} nach {minutes} Minuten ohne Eingabe automatisch gesperrt.</translation>
    </message>
    <message>
        <source>Wrong PIN. 1 attempt left before a 1-minute wait.</source>
        <translation>Falsche PIN. Noch 1 Versuch, dann 1 Minute Wartezeit.</translation>
    </message>
    <message>
        <source>Wrong PIN. {left} attempts left before a 1-minute wait.</source>
        <translation>Falsche PIN. Noch {left} Versuche, dann 1 Minute Wartezeit.</translation>
    </message>
    <message>
        <source>Too many attempts. Try again in {seconds} s.</source>
        <translation>Zu viele Versuche. Erneut versuchen in {seconds} s.</translation>
    </message>
    <message>
        <source>Forgot the PIN? Press F1.</source>
        <translation>PIN vergessen? Drücken Sie F1.</translation>
    </message>
    <message>
        <source>Ask your IT support to remove the PIN. No data are lost.</source>
        <translation>Bitten Sie Ihre IT-Betreuung, die PIN zu entfernen. Es gehen keine Daten verloren.</translation>
    </message>
    <message>
        <source>Locked at {time}.</source>
        <translation>Um {time} gesperrt.</translation>
    </message>
    <message>
        <source>Who is the therapist?</source>
        <translation>Wer behandelt?</translation>
    </message>
</context>
<context>
    <name>LogDialog</name>
    <message>
        <source>Log</source>
        <translation>Protokoll</translation>
    </message>
    <message>
        <source>When</source>
        <translation>Wann</translation>
    </message>
    <message>
        <source>Who</source>
        <translation>Wer</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>Log: {n} entries</source>
        <translation>Protokoll: {n} Einträge</translation>
    </message>
    <message>
        <source>Details</source>
        <translation>Details</translation>
    </message>
    <message>
        <source>Patient</source>
        <translation>Patient</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>Fertig</translation>
    </message>
    <message>
        <source>Entries are added and never changed. The log protects against mistakes, not against someone with full access to this computer. It stores no names: those shown here come from the patient list.</source>
        <translation>Einträge kommen nur hinzu und werden nie geändert. Das Protokoll schützt vor Versehen, nicht vor jemandem mit vollem Zugriff auf diesen Computer. Es speichert keine Namen: Die hier gezeigten stammen aus der Patientenliste.</translation>
    </message>
</context>
<context>
    <name>ManualForm</name>
    <message>
        <source>Active</source>
        <translation>Aktiv</translation>
    </message>
    <message>
        <source>Passive</source>
        <translation>Passiv</translation>
    </message>
    <message>
        <source>Carpus</source>
        <translation>Carpus</translation>
    </message>
    <message>
        <source>previous</source>
        <translation>zuletzt</translation>
    </message>
    <message>
        <source>Extension: − is a deficit, + is hyperextension. Values in italics were measured by Carpus on this day ({sign} = minimum) and are not saved here. Type over them to enter goniometer values.</source>
        <translation>Extension: − ist ein Streckdefizit, + eine Überstreckung. Kursive Werte hat Carpus an diesem Tag gemessen ({sign} = Mindestwert); sie werden hier nicht gespeichert. Zum Eintragen von Goniometerwerten überschreiben. FKHA: Fingerkuppen-Hohlhand-Abstand.</translation>
    </message>
</context>
<context>
    <name>ManualMeasurementsFlow</name>
    <message>
        <source>Leave without saving?</source>
        <translation>Ohne Speichern verlassen?</translation>
    </message>
    <message>
        <source>Some values have not been saved.</source>
        <translation>Einige Werte sind noch nicht gespeichert.</translation>
    </message>
    <message>
        <source>Save or discard the values.</source>
        <translation>Speichern oder verwerfen Sie die Werte.</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Check the unusual values, or save them as entered</source>
        <translation>Ungewöhnliche Werte prüfen oder wie eingegeben speichern</translation>
    </message>
    <message>
        <source>Check the values before you save them.</source>
        <translation>Prüfen Sie die Werte, bevor Sie sie speichern.</translation>
    </message>
    <message>
        <source>Save as entered</source>
        <translation>Wie eingegeben speichern</translation>
    </message>
    <message>
        <source>Back to the form</source>
        <translation>Zurück zum Formular</translation>
    </message>
</context>
<context>
    <name>ManualMeasurementsScreen</name>
    <message>
        <source>Date of measurement</source>
        <translation>Messdatum</translation>
    </message>
    <message>
        <source>Other measures</source>
        <translation>Andere Maße</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Save values</source>
        <translation>Werte speichern</translation>
    </message>
    <message>
        <source>Saved.</source>
        <translation>Gespeichert.</translation>
    </message>
    <message>
        <source>Leave empty what was not measured. These entries do not change values measured by Carpus.</source>
        <translation>Lassen Sie leer, was nicht gemessen wurde. Diese Einträge ändern keine Messwerte von Carpus.</translation>
    </message>
    <message>
        <source>The Carpus session of this day is simulated and not shown.</source>
        <translation>Die Carpus-Sitzung dieses Tages ist simuliert und wird nicht gezeigt.</translation>
    </message>
    <message>
        <source>Values are saved with initials and time. Later changes stay visible.</source>
        <translation>Werte werden mit Kürzel und Zeit gespeichert. Spätere Änderungen bleiben sichtbar.</translation>
    </message>
    <message>
        <source>Other measures…</source>
        <translation>Andere Maße…</translation>
    </message>
    <message>
        <source>Manual measurements, {day}</source>
        <translation>Manuelle Messungen, {day}</translation>
    </message>
    <message>
        <source>Manual and Carpus values are kept separate</source>
        <translation>Manuelle Werte und Carpus-Werte bleiben getrennt</translation>
    </message>
    <message>
        <source>Some values of this or another hand or day are not saved yet.</source>
        <translation>Einige Werte dieser oder einer anderen Hand oder eines anderen Tages sind noch nicht gespeichert.</translation>
    </message>
    <message>
        <source>Entered by {initials}.</source>
        <translation>Eingetragen von {initials}.</translation>
    </message>
    <message>
        <source>Reference grip strength for this age and sex: {mean} ± {sd} kg ({source}, Smedley dynamometer).</source>
        <translation>Referenz der Griffkraft für Alter und Geschlecht: {mean} ± {sd} kg ({source}, Smedley-Dynamometer).</translation>
    </message>
    <message>
        <source>The two kinds of values are neither averaged nor subtracted. Change is assessed within one method only.</source>
        <translation>Die beiden Arten von Werten werden weder gemittelt noch voneinander abgezogen. Eine Änderung wird nur innerhalb einer Methode beurteilt.</translation>
    </message>
    <message>
        <source>At least {score}: proposed from the recording of {day}</source>
        <translation>Mindestens {score}: Vorschlag aus der Aufnahme vom {day}</translation>
    </message>
</context>
<context>
    <name>ManualValueChart</name>
    <message>
        <source>Carpus, mean</source>
        <translation>Carpus, Mittel</translation>
    </message>
    <message>
        <source>passive {value}</source>
        <translation>passiv {value}</translation>
    </message>
    <message>
        <source>Carpus {value}</source>
        <translation>Carpus {value}</translation>
    </message>
    <message>
        <source>active {value}</source>
        <translation>aktiv {value}</translation>
    </message>
    <message>
        <source>No manual measurements yet.</source>
        <translation>Noch keine manuellen Messungen.</translation>
    </message>
    <message>
        <source>manual, active</source>
        <translation>manuell, aktiv</translation>
    </message>
    <message>
        <source>manual</source>
        <translation>manuell</translation>
    </message>
    <message>
        <source>manual, passive</source>
        <translation>manuell, passiv</translation>
    </message>
    <message>
        <source>{name} over time</source>
        <translation>{name} im zeitlichen Verlauf</translation>
    </message>
</context>
<context>
    <name>MarkerFrameView</name>
    <message>
        <source>{marker}?</source>
        <translation>{marker}?</translation>
    </message>
    <message>
        <source>What is this?</source>
        <translation>Was ist das?</translation>
    </message>
    <message>
        <source>Marker found · {width} px wide</source>
        <translation>Marker gefunden · {width} px breit</translation>
    </message>
    <message>
        <source>Found · {width} px</source>
        <translation>Gefunden · {width} px</translation>
    </message>
    <message>
        <source>Image to click the markers on</source>
        <translation>Bild zum Anklicken der Marker</translation>
    </message>
</context>
<context>
    <name>MarkerRow</name>
    <message>
        <source>{size} mm</source>
        <translation>{size} mm</translation>
    </message>
    <message>
        <source>occluded</source>
        <translation>verdeckt</translation>
    </message>
    <message>
        <source>{now}, was {size} mm</source>
        <translation>{now}, zuvor {size} mm</translation>
    </message>
</context>
<context>
    <name>MarkersFlow</name>
    <message>
        <source>Stay here, or go back to the camera.</source>
        <translation>Hier bleiben oder zurück zur Kamera.</translation>
    </message>
    <message>
        <source>Back to the camera</source>
        <translation>Zurück zur Kamera</translation>
    </message>
    <message>
        <source>Stay here</source>
        <translation>Hier bleiben</translation>
    </message>
    <message>
        <source>Depth and colour of {name} are misaligned by {px} pixels.</source>
        <translation>Tiefe und Farbe von {name} sind um {px} Pixel gegeneinander verschoben.</translation>
    </message>
    <message>
        <source>Open it again with depth aligned to colour, then click the markers again.</source>
        <translation>Öffnen Sie die Aufnahme erneut. Carpus richtet dabei die Tiefe an der Farbe aus. Klicken Sie danach die Marker neu an.</translation>
    </message>
    <message>
        <source>Leave this screen?</source>
        <translation>Diese Seite verlassen?</translation>
    </message>
    <message>
        <source>The recording was not changed. It does not say whether depth and colour are aligned.</source>
        <translation>Die Aufnahme wurde nicht verändert. Sie gibt nicht an, ob Tiefe und Farbe deckungsgleich sind.</translation>
    </message>
    <message>
        <source>The labels on this image would be lost.</source>
        <translation>Die Bezeichnungen auf diesem Bild gingen verloren.</translation>
    </message>
    <message>
        <source>Do not change it</source>
        <translation>Nicht ändern</translation>
    </message>
    <message>
        <source>Open the recording again</source>
        <translation>Aufnahme neu öffnen</translation>
    </message>
</context>
<context>
    <name>MarkersScreen</name>
    <message>
        <source>Wrist cannot reach neutral…</source>
        <translation>Ausgangsstellung eingeben…</translation>
    </message>
    <message>
        <source>Start anyway (&amp;uncertain)</source>
        <translation>Trotzdem &amp;starten</translation>
    </message>
    <message>
        <source>Click all again</source>
        <translation>Alle neu anklicken</translation>
    </message>
    <message>
        <source>Waiting for the camera image</source>
        <translation>Warten auf das Kamerabild</translation>
    </message>
    <message>
        <source>No blue marker here. Click nearer.</source>
        <translation>Hier ist kein blauer Marker. Klicken Sie näher.</translation>
    </message>
    <message>
        <source>Already the {name}</source>
        <translation>Schon vergeben: {name}</translation>
    </message>
    <message>
        <source>This marker is already the {name}. Click another one.</source>
        <translation>Dieser Marker ist schon „{name}“. Klicken Sie einen anderen an.</translation>
    </message>
    <message>
        <source>Start position {angles} (entered)</source>
        <translation>Ausgangsstellung {angles} (eingetragen)</translation>
    </message>
    <message>
        <source>Drag a label to its marker. Two labels can be swapped.</source>
        <translation>Eine Bezeichnung auf ihren Marker ziehen. Zwei Bezeichnungen lassen sich tauschen.</translation>
    </message>
    <message>
        <source>The hand lies flat and still, palm down. Fingers that stay bent are fine.</source>
        <translation>Hand flach und ruhig, Handfläche nach unten. Gebeugte Finger sind in Ordnung.</translation>
    </message>
    <message>
        <source>Click these again</source>
        <translation>Diese neu anklicken</translation>
    </message>
    <message>
        <source>The labels stay as they are until you change one.</source>
        <translation>Die Bezeichnungen bleiben, bis Sie eine ändern.</translation>
    </message>
    <message>
        <source>All labels are correct</source>
        <translation>Alle stimmen</translation>
    </message>
    <message>
        <source>New image</source>
        <translation>Neues Bild</translation>
    </message>
</context>
<context>
    <name>MeasureRow</name>
    <message>
        <source>location</source>
        <translation>Messort</translation>
    </message>
    <message>
        <source>{name}: location of the measurement</source>
        <translation>{name}: Messort</translation>
    </message>
    <message>
        <source>unanswered questions {numbers}</source>
        <translation>unbeantwortete Fragen {numbers}</translation>
    </message>
    <message>
        <source>{side} {value}</source>
        <translation>{side} {value}</translation>
    </message>
    <message>
        <source>changed</source>
        <translation>geändert</translation>
    </message>
    <message>
        <source>mean {value}</source>
        <translation>Ø {value}</translation>
    </message>
    <message>
        <source>or {count} answers, {least}–{most}</source>
        <translation>oder {count} Antworten, {least}–{most}</translation>
    </message>
    <message>
        <source>{name}: answers by number</source>
        <translation>{name}: Antworten als Zahlen</translation>
    </message>
    <message>
        <source>{count} of {all}</source>
        <translation>{count} von {all}</translation>
    </message>
    <message>
        <source>Enter the answers of the paper form in order, with - for no answer. Only the score is saved.</source>
        <translation>Antworten des Papierbogens der Reihe nach eingeben, „-“ für keine Antwort. Gespeichert wird nur die Punktzahl.</translation>
    </message>
    <message>
        <source>not a valid answer</source>
        <translation>keine gültige Antwort</translation>
    </message>
</context>
<context>
    <name>Messages</name>
    <message>
        <source>Continue</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>A session of {name} was interrupted on {day} at {time}. It has been recovered.</source>
        <translation>Eine Sitzung von {name} wurde am {day} um {time} unterbrochen. Sie wurde wiederhergestellt.</translation>
    </message>
    <message>
        <source>All data up to {kept} are safe. At most the last second is missing, or more where results were delayed.</source>
        <translation>Alle Daten bis {kept} sind sicher. Höchstens die letzte Sekunde fehlt, mehr nur bei verzögerten Ergebnissen.</translation>
    </message>
    <message>
        <source>Review it now or later. It stays in the patient’s session list.</source>
        <translation>Sehen Sie die Sitzung jetzt oder später an. Sie bleibt in der Sitzungsliste.</translation>
    </message>
    <message>
        <source>Waiting for the camera … {seconds} s</source>
        <translation>Warten auf die Kamera … {seconds} s</translation>
    </message>
</context>
<context>
    <name>NavigationButton</name>
    <message>
        <source>{name}, you are here</source>
        <translation>{name}, hier sind Sie</translation>
    </message>
    <message>
        <source>{name}, done</source>
        <translation>{name}, erledigt</translation>
    </message>
</context>
<context>
    <name>NoteDialog</name>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Save note</source>
        <translation>Notiz speichern</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Note at this moment</source>
        <translation>Notiz zu diesem Moment</translation>
    </message>
    <message>
        <source>Stopped for pain</source>
        <translation>Wegen Schmerz abgebrochen</translation>
    </message>
    <message>
        <source>Strap loosened</source>
        <translation>Gurt gelockert</translation>
    </message>
    <message>
        <source>Rest</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>What happened? Enter no names.</source>
        <translation>Was ist geschehen? Keine Namen eingeben.</translation>
    </message>
    <message>
        <source>Active from here on</source>
        <translation>Aktiv ab hier</translation>
    </message>
    <message>
        <source>Passive from here on</source>
        <translation>Passiv ab hier</translation>
    </message>
</context>
<context>
    <name>NoticeStrip</name>
    <message>
        <source>Later</source>
        <translation>Später</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
</context>
<context>
    <name>NumberCard</name>
    <message>
        <source>{finger}, total active motion (TAM)</source>
        <translation>{finger}, aktive Gesamtbeweglichkeit (TAM)</translation>
    </message>
    <message>
        <source>{joint}, {side}</source>
        <translation>{joint}, {side}</translation>
    </message>
    <message>
        <source>uncertain, excluded</source>
        <translation>unsicher, ausgeschlossen</translation>
    </message>
    <message>
        <source>uncertain</source>
        <translation>unsicher</translation>
    </message>
    <message>
        <source>no value</source>
        <translation>kein Wert</translation>
    </message>
    <message>
        <source>predicted</source>
        <translation>vorhergesagt</translation>
    </message>
    <message>
        <source>of {asked}</source>
        <translation>von {asked}</translation>
    </message>
    <message>
        <source>Best today</source>
        <translation>Bestwert heute</translation>
    </message>
    <message>
        <source>Best {movement}</source>
        <translation>Bestwert {movement}</translation>
    </message>
    <message>
        <source>Goal {angle}</source>
        <translation>Ziel {angle}</translation>
    </message>
    <message>
        <source>Repetitions</source>
        <translation>Wiederholungen</translation>
    </message>
    <message>
        <source>inferred from PIP</source>
        <translation>vom PIP abgeleitet</translation>
    </message>
</context>
<context>
    <name>PainDialog</name>
    <message>
        <source>Pain now, 0 (none) to 10 (worst)</source>
        <translation>Schmerz jetzt, 0 (keiner) bis 10 (stärkster)</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>If pain is 5 or more, or has risen by 2, stop the exercise. Keys: 0 to 9. For 10, press 1, then 0.</source>
        <translation>Bei Schmerz ab 5 oder einem Anstieg um 2 die Übung beenden. Tasten: 0 bis 9. Für 10 erst 1, dann 0 drücken.</translation>
    </message>
</context>
<context>
    <name>PartRow</name>
    <message>
        <source>times</source>
        <translation>mal</translation>
    </message>
    <message>
        <source>seconds</source>
        <translation>Sekunden</translation>
    </message>
    <message>
        <source>no rest</source>
        <translation>keine Pause</translation>
    </message>
    <message>
        <source>Earlier</source>
        <translation>Hoch</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Exercise</source>
        <translation>Übung</translation>
    </message>
    <message>
        <source>How often or how long</source>
        <translation>Wie oft oder wie lange</translation>
    </message>
    <message>
        <source>Times or seconds</source>
        <translation>Mal oder Sekunden</translation>
    </message>
    <message>
        <source>Rest after it</source>
        <translation>Pause danach</translation>
    </message>
</context>
<context>
    <name>PatientCardView</name>
    <message>
        <source>&amp;Edit…</source>
        <translation>&amp;Bearbeiten…</translation>
    </message>
    <message>
        <source>&amp;Other exercise…</source>
        <translation>A&amp;ndere Übung…</translation>
    </message>
    <message>
        <source>&amp;Review</source>
        <translation>&amp;Auswertung</translation>
    </message>
    <message>
        <source>&amp;Progress</source>
        <translation>&amp;Verlauf</translation>
    </message>
    <message>
        <source>All &amp;sessions</source>
        <translation>Alle &amp;Sitzungen</translation>
    </message>
    <message>
        <source>Simulated: excluded from analysis</source>
        <translation>Simuliert: von der Auswertung ausgeschlossen</translation>
    </message>
    <message>
        <source>Place markers as on {day}</source>
        <translation>Marker kleben wie am {day}</translation>
    </message>
    <message>
        <source>No analysed session yet</source>
        <translation>Noch keine ausgewertete Sitzung</translation>
    </message>
    <message>
        <source>Only simulated sessions so far (excluded).</source>
        <translation>Bisher nur simulierte Sitzungen (ausgeschlossen).</translation>
    </message>
    <message>
        <source>Attach the markers, then start.</source>
        <translation>Kleben Sie die Marker auf, dann starten Sie.</translation>
    </message>
    <message>
        <source>No session yet</source>
        <translation>Noch keine Sitzung</translation>
    </message>
    <message>
        <source>Note of {day}</source>
        <translation>Notiz vom {day}</translation>
    </message>
    <message>
        <source>Start practice</source>
        <translation>Testsitzung starten</translation>
    </message>
    <message>
        <source>Start from a file · no camera</source>
        <translation>Aus Datei starten · keine Kamera</translation>
    </message>
    <message>
        <source>Start first session</source>
        <translation>Erste Sitzung starten</translation>
    </message>
    <message>
        <source>A simulated patient moves in front of a simulated camera. Try every step without a patient.</source>
        <translation>Ein simulierter Patient bewegt sich vor einer simulierten Kamera. Probieren Sie jeden Schritt ohne Patient aus.</translation>
    </message>
    <message>
        <source>{ordinal} session</source>
        <translation>{ordinal} Sitzung</translation>
    </message>
    <message>
        <source>Start session with same set-up</source>
        <translation>Sitzung starten, gleicher Aufbau</translation>
    </message>
</context>
<context>
    <name>PatientForm</name>
    <message>
        <source>&amp;Another</source>
        <translation>&amp;Anderes</translation>
    </message>
    <message>
        <source>Right</source>
        <translation>Rechts</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>Links</translation>
    </message>
    <message>
        <source>Not known</source>
        <translation>Unbekannt</translation>
    </message>
    <message>
        <source>Real name: {count} characters too long</source>
        <translation>Echter Name: {count} Zeichen zu viel</translation>
    </message>
    <message>
        <source>Diagnosis: {count} characters too long</source>
        <translation>Diagnose: {count} Zeichen zu viel</translation>
    </message>
    <message>
        <source>Operation</source>
        <translation>Operation</translation>
    </message>
    <message>
        <source>Injury</source>
        <translation>Verletzung</translation>
    </message>
    <message>
        <source>Close without saving</source>
        <translation>Schließen ohne Speichern</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Edit patient</source>
        <translation>Patient bearbeiten</translation>
    </message>
    <message>
        <source>Save changes</source>
        <translation>Änderungen speichern</translation>
    </message>
    <message>
        <source>Affected hand</source>
        <translation>Betroffene Hand</translation>
    </message>
    <message>
        <source>Writes with</source>
        <translation>Schreibt mit</translation>
    </message>
    <message>
        <source>&amp;Since</source>
        <translation>&amp;Seit</translation>
    </message>
    <message>
        <source>N&amp;ote (no names)</source>
        <translation>N&amp;otiz (keine Namen)</translation>
    </message>
    <message>
        <source>Archi&amp;ve or delete…</source>
        <translation>Arc&amp;hivieren oder löschen…</translation>
    </message>
    <message>
        <source>New patient</source>
        <translation>Neuer Patient</translation>
    </message>
    <message>
        <source>Add patient</source>
        <translation>Patient anlegen</translation>
    </message>
    <message>
        <source>Which hand is affected?</source>
        <translation>Welche Hand ist betroffen?</translation>
    </message>
    <message>
        <source>Which hand writes?</source>
        <translation>Mit welcher Hand wird geschrieben?</translation>
    </message>
    <message>
        <source>Operation or injury?</source>
        <translation>Operation oder Verletzung?</translation>
    </message>
    <message>
        <source>&amp;Real name</source>
        <translation>&amp;Echter Name</translation>
    </message>
    <message>
        <source>&amp;Birth date</source>
        <translation>&amp;Geburtsdatum</translation>
    </message>
    <message>
        <source>Record nu&amp;mber</source>
        <translation>Aktenn&amp;ummer</translation>
    </message>
    <message>
        <source>Record number: {count} characters too long</source>
        <translation>Aktennummer: {count} Zeichen zu viel</translation>
    </message>
    <message>
        <source>Sex</source>
        <translation>Geschlecht</translation>
    </message>
    <message>
        <source>Female</source>
        <translation>Weiblich</translation>
    </message>
    <message>
        <source>Male</source>
        <translation>Männlich</translation>
    </message>
    <message>
        <source>&amp;Diagnosis or operation</source>
        <translation>&amp;Diagnose oder Operation</translation>
    </message>
    <message>
        <source>Other</source>
        <translation>Divers</translation>
    </message>
    <message>
        <source>Birth date: {problem}</source>
        <translation>Geburtsdatum: {problem}</translation>
    </message>
    <message>
        <source>Since: {problem}</source>
        <translation>Seit: {problem}</translation>
    </message>
    <message>
        <source>Save in diagnosis &amp;list</source>
        <translation>In Diagnose&amp;liste speichern</translation>
    </message>
    <message>
        <source>Pseudonym: {count} characters too long</source>
        <translation>Pseudonym: {count} Zeichen zu viel</translation>
    </message>
    <message>
        <source>Enter a pseudonym.</source>
        <translation>Geben Sie ein Pseudonym ein.</translation>
    </message>
    <message>
        <source>The pseudonym “{name}” is already in use. Choose another one.</source>
        <translation>Das Pseudonym „{name}“ ist schon vergeben. Wählen Sie ein anderes.</translation>
    </message>
    <message>
        <source>Pseudo&amp;nym</source>
        <translation>Pseudo&amp;nym</translation>
    </message>
    <message>
        <source>The pseudonym is shown on all screens and can be spoken aloud: no real name, no initials, no birth date. Real name, birth date, record number, sex and diagnosis are optional. They stay in the patient list and are never in a session file or an export.</source>
        <translation>Das Pseudonym steht auf allen Bildschirmen und darf laut genannt werden: kein echter Name, keine Initialen, kein Geburtsdatum. Echter Name, Geburtsdatum, Aktennummer, Geschlecht und Diagnose sind freiwillig. Sie bleiben in der Patientenliste und kommen nie in eine Sitzungsdatei oder einen Export.</translation>
    </message>
</context>
<context>
    <name>PatientList</name>
    <message>
        <source>Patients</source>
        <translation>Patienten</translation>
    </message>
</context>
<context>
    <name>PatientView</name>
    <message>
        <source>{done} of {asked}</source>
        <translation>{done} von {asked}</translation>
    </message>
    <message>
        <source>Goal {angle}</source>
        <translation>Ziel {angle}</translation>
    </message>
    <message>
        <source>Goal</source>
        <translation>Ziel</translation>
    </message>
</context>
<context>
    <name>PatientWindow</name>
    <message>
        <source>Patient’s view (Esc closes it)</source>
        <translation>Patientenansicht (Esc schließt sie)</translation>
    </message>
</context>
<context>
    <name>PatientsScreen</name>
    <message>
        <source>Ctrl+F</source>
        <translation>Strg+F</translation>
    </message>
    <message>
        <source>New patient</source>
        <translation>Neu</translation>
    </message>
    <message>
        <source>Ctrl+N</source>
        <translation>Strg+N</translation>
    </message>
    <message>
        <source>Patients</source>
        <translation>Patienten</translation>
    </message>
    <message>
        <source>choose</source>
        <translation>wählen</translation>
    </message>
    <message>
        <source>Enter</source>
        <translation>Eingabetaste</translation>
    </message>
    <message>
        <source>start</source>
        <translation>starten</translation>
    </message>
    <message>
        <source>help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>Practice patient</source>
        <translation>Testpatient</translation>
    </message>
    <message>
        <source>In the archi&amp;ve: {names}</source>
        <translation>Im Archi&amp;v: {names}</translation>
    </message>
    <message>
        <source>found by name</source>
        <translation>gefunden über den Namen</translation>
    </message>
    <message>
        <source>found by birth date</source>
        <translation>gefunden über das Geburtsdatum</translation>
    </message>
    <message>
        <source>found by record number</source>
        <translation>gefunden über die Aktennummer</translation>
    </message>
    <message>
        <source>Name, number, birth date</source>
        <translation>Name, Nummer, Geburtsdatum</translation>
    </message>
    <message>
        <source>Pseudonym</source>
        <translation>Pseudonym</translation>
    </message>
</context>
<context>
    <name>PinDialog</name>
    <message>
        <source>&amp;New PIN</source>
        <translation>&amp;Neue PIN</translation>
    </message>
    <message>
        <source>Change the PIN</source>
        <translation>PIN ändern</translation>
    </message>
    <message>
        <source>Set a PIN</source>
        <translation>PIN festlegen</translation>
    </message>
    <message>
        <source>At least four characters, digits or letters. A PIN only hides the screen. It does not encrypt files.</source>
        <translation>Mindestens vier Zeichen, Ziffern oder Buchstaben. Eine PIN verbirgt nur den Bildschirm. Sie verschlüsselt keine Dateien.</translation>
    </message>
    <message>
        <source>&amp;Current PIN</source>
        <translation>&amp;Aktuelle PIN</translation>
    </message>
    <message>
        <source>Set PIN</source>
        <translation>PIN festlegen</translation>
    </message>
    <message>
        <source>&amp;Remove PIN</source>
        <translation>PIN ent&amp;fernen</translation>
    </message>
    <message>
        <source>Repeat new &amp;PIN</source>
        <translation>Neue PIN &amp;wiederholen</translation>
    </message>
    <message>
        <source>A PIN needs at least four characters.</source>
        <translation>Eine PIN braucht mindestens vier Zeichen.</translation>
    </message>
    <message>
        <source>The two PINs differ.</source>
        <translation>Die beiden PINs sind verschieden.</translation>
    </message>
</context>
<context>
    <name>PlaybackControls</name>
    <message>
        <source>Play (Space)</source>
        <translation>Abspielen (Leertaste)</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Stopp</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>{factor}× speed</source>
        <translation>Tempo {factor}×</translation>
    </message>
    <message>
        <source>Previous frame (←)</source>
        <translation>Voriges Bild (←)</translation>
    </message>
    <message>
        <source>Next frame (→)</source>
        <translation>Nächstes Bild (→)</translation>
    </message>
</context>
<context>
    <name>Player</name>
    <message>
        <source>Space</source>
        <translation>Leertaste</translation>
    </message>
    <message>
        <source>play</source>
        <translation>abspielen</translation>
    </message>
    <message>
        <source>Repetition…</source>
        <translation>Wiederholung…</translation>
    </message>
    <message>
        <source>frame</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>Mark as passive or excluded (X). [ and ] select another repetition.</source>
        <translation>Als passiv oder ausgeschlossen kennzeichnen (X). [ und ] wählen eine andere Wiederholung.</translation>
    </message>
</context>
<context>
    <name>PlotMenu</name>
    <message>
        <source>Show all</source>
        <translation>Alles anzeigen</translation>
    </message>
    <message>
        <source>Zoom in</source>
        <translation>Vergrößern</translation>
    </message>
    <message>
        <source>Zoom out</source>
        <translation>Verkleinern</translation>
    </message>
    <message>
        <source>Save drawing (SVG)…</source>
        <translation>Zeichnung speichern (SVG)…</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>Copy image</source>
        <translation>Bild kopieren</translation>
    </message>
    <message>
        <source>Save image (PNG)…</source>
        <translation>Bild speichern (PNG)…</translation>
    </message>
</context>
<context>
    <name>PracticeSystemCard</name>
    <message>
        <source>Change…</source>
        <translation>Ändern…</translation>
    </message>
    <message>
        <source>Test the folders</source>
        <translation>Ordner prüfen</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>Ordner wählen</translation>
    </message>
    <message>
        <source>No folder chosen</source>
        <translation>Kein Ordner gewählt</translation>
    </message>
    <message>
        <source>Turn off</source>
        <translation>Ausschalten</translation>
    </message>
    <message>
        <source>The clinic software writes a patient as a GDT 2.1 file into the first folder, and Carpus opens the patient. “Send to clinic software” next to a report writes its values and the PDF into the second folder. These files contain real names.</source>
        <translation>Die Praxissoftware legt die Daten eines Patienten als GDT-2.1-Datei im ersten Ordner ab, und Carpus öffnet den Patienten. „An Praxissoftware senden“ neben einem Bericht legt Werte und PDF im zweiten ab. Diese Dateien enthalten echte Namen.</translation>
    </message>
    <message>
        <source>Clinic software (GDT)</source>
        <translation>Praxissoftware (GDT)</translation>
    </message>
    <message>
        <source>Patients from the clinic software</source>
        <translation>Patienten aus der Praxissoftware</translation>
    </message>
    <message>
        <source>Results for the clinic software</source>
        <translation>Ergebnisse für die Praxissoftware</translation>
    </message>
    <message>
        <source>The demo does not read patients from the clinic software.</source>
        <translation>Die Demo liest keine Patienten aus der Praxissoftware.</translation>
    </message>
    <message>
        <source>Write results as FHIR R4 (JSON) too</source>
        <translation>Ergebnisse auch als FHIR R4 (JSON) schreiben</translation>
    </message>
</context>
<context>
    <name>PreviousPhoto</name>
    <message>
        <source>Last time, {day}</source>
        <translation>Letztes Mal, {day}</translation>
    </message>
</context>
<context>
    <name>ProgressChart</name>
    <message>
        <source>Range of motion over the sessions</source>
        <translation>Bewegungsausmaß im Verlauf der Sitzungen</translation>
    </message>
    <message>
        <source>{name} {value}, {count} repetitions</source>
        <translation>{name} {value}, {count} Wiederholungen</translation>
    </message>
    <message>
        <source>Camera {distance} cm away</source>
        <translation>Kamera {distance} cm entfernt</translation>
    </message>
    <message>
        <source>Click to open the session</source>
        <translation>Ein Klick öffnet die Sitzung</translation>
    </message>
</context>
<context>
    <name>ProgressFlow</name>
    <message>
        <source>Save table</source>
        <translation>Tabelle speichern</translation>
    </message>
    <message>
        <source>progress.csv</source>
        <translation>Verlauf.csv</translation>
    </message>
</context>
<context>
    <name>ProgressScreen</name>
    <message>
        <source>Progress report</source>
        <translation>Verlaufsbericht</translation>
    </message>
    <message>
        <source>Save table…</source>
        <translation>Tabelle speichern…</translation>
    </message>
    <message>
        <source>Exercise and hand</source>
        <translation>Übung und Hand</translation>
    </message>
    <message>
        <source>1 session, {last}</source>
        <translation>1 Sitzung, {last}</translation>
    </message>
    <message>
        <source>{count} sessions, {first} – {last}</source>
        <translation>{count} Sitzungen, {first} – {last}</translation>
    </message>
    <message>
        <source>Reading the sessions…</source>
        <translation>Sitzungen werden gelesen…</translation>
    </message>
    <message>
        <source>The sessions cannot be read.</source>
        <translation>Die Sitzungen lassen sich nicht lesen.</translation>
    </message>
    <message>
        <source>Simulated sessions are shown for practice only and excluded from analysis.</source>
        <translation>Simulierte Sitzungen dienen nur der Übung und sind von der Auswertung ausgeschlossen.</translation>
    </message>
    <message>
        <source>{count} sessions, {last}</source>
        <translation>{count} Sitzungen, {last}</translation>
    </message>
    <message>
        <source>First to last session</source>
        <translation>Erste bis letzte Sitzung</translation>
    </message>
    <message>
        <source>Comparability</source>
        <translation>Vergleichbarkeit</translation>
    </message>
    <message>
        <source>Save image…</source>
        <translation>Bild speichern…</translation>
    </message>
    <message>
        <source>&amp;Manual values…</source>
        <translation>&amp;Manuelle Messwerte…</translation>
    </message>
    <message>
        <source>Value shown</source>
        <translation>Gezeigter Wert</translation>
    </message>
    <message>
        <source>Manual measurements</source>
        <translation>Manuelle Messungen</translation>
    </message>
</context>
<context>
    <name>RecordListsController</name>
    <message>
        <source>{n} sessions</source>
        <translation>{n} Sitzungen</translation>
    </message>
    <message>
        <source>session of {day}</source>
        <translation>Sitzung vom {day}</translation>
    </message>
    <message>
        <source>archived on {day}</source>
        <translation>archiviert am {day}</translation>
    </message>
    <message>
        <source>Archive</source>
        <translation>Archiv</translation>
    </message>
    <message>
        <source>The archive is empty.</source>
        <translation>Das Archiv ist leer.</translation>
    </message>
    <message>
        <source>1 file</source>
        <translation>1 Datei</translation>
    </message>
    <message>
        <source>{n} files</source>
        <translation>{n} Dateien</translation>
    </message>
    <message>
        <source>1 value</source>
        <translation>1 Wert</translation>
    </message>
    <message>
        <source>{n} values</source>
        <translation>{n} Werte</translation>
    </message>
    <message>
        <source>1 study</source>
        <translation>1 Studie</translation>
    </message>
    <message>
        <source>{n} studies</source>
        <translation>{n} Studien</translation>
    </message>
    <message>
        <source>No record is past its retention period.</source>
        <translation>Bei keinen Unterlagen ist die Aufbewahrungsfrist abgelaufen.</translation>
    </message>
    <message>
        <source>Set the retention period first.</source>
        <translation>Legen Sie zuerst die Aufbewahrungsfrist fest.</translation>
    </message>
    <message>
        <source>The last session was more than {n} years ago. Nothing is deleted automatically.</source>
        <translation>Die letzte Sitzung ist mehr als {n} Jahre her. Nichts wird automatisch gelöscht.</translation>
    </message>
    <message>
        <source>1 session on {last}, retention until {until}</source>
        <translation>1 Sitzung am {last}, Aufbewahrung bis {until}</translation>
    </message>
    <message>
        <source>{n} sessions, the last on {last}, retention until {until}</source>
        <translation>{n} Sitzungen, die letzte am {last}, Aufbewahrung bis {until}</translation>
    </message>
    <message>
        <source>Excluded from all lists and results. Everything can be restored.</source>
        <translation>Von allen Listen und Ergebnissen ausgeschlossen. Alles lässt sich wiederherstellen.</translation>
    </message>
    <message>
        <source>1 remaining</source>
        <translation>noch 1 übrig</translation>
    </message>
    <message>
        <source>{n} remaining</source>
        <translation>noch {n} übrig</translation>
    </message>
    <message>
        <source>automatic</source>
        <translation>automatisch</translation>
    </message>
    <message>
        <source>de-identified</source>
        <translation>ohne Personendaten</translation>
    </message>
    <message>
        <source>with a PIN</source>
        <translation>mit PIN</translation>
    </message>
    <message>
        <source>opened</source>
        <translation>geöffnet</translation>
    </message>
    <message>
        <source>recorded</source>
        <translation>aufgenommen</translation>
    </message>
    <message>
        <source>added</source>
        <translation>hinzugefügt</translation>
    </message>
    <message>
        <source>changed</source>
        <translation>geändert</translation>
    </message>
    <message>
        <source>exported</source>
        <translation>exportiert</translation>
    </message>
    <message>
        <source>report saved</source>
        <translation>Bericht gespeichert</translation>
    </message>
    <message>
        <source>re-analysed</source>
        <translation>neu analysiert</translation>
    </message>
    <message>
        <source>restored from archive</source>
        <translation>aus dem Archiv wiederhergestellt</translation>
    </message>
    <message>
        <source>deletion started</source>
        <translation>Löschen begonnen</translation>
    </message>
    <message>
        <source>deleted</source>
        <translation>gelöscht</translation>
    </message>
    <message>
        <source>backup verified</source>
        <translation>Sicherung geprüft</translation>
    </message>
    <message>
        <source>backup restored</source>
        <translation>Sicherung wiederhergestellt</translation>
    </message>
    <message>
        <source>wrong PIN</source>
        <translation>falsche PIN</translation>
    </message>
    <message>
        <source>manual values entered</source>
        <translation>manuelle Messwerte eingetragen</translation>
    </message>
    <message>
        <source>moved</source>
        <translation>verschoben</translation>
    </message>
    <message>
        <source>excluded</source>
        <translation>ausgeschlossen</translation>
    </message>
    <message>
        <source>included again</source>
        <translation>wieder eingeschlossen</translation>
    </message>
    <message>
        <source>exercise changed</source>
        <translation>Übung geändert</translation>
    </message>
    <message>
        <source>recovered</source>
        <translation>wiederhergestellt</translation>
    </message>
    <message>
        <source>archived</source>
        <translation>archiviert</translation>
    </message>
    <message>
        <source>backed up</source>
        <translation>gesichert</translation>
    </message>
    <message>
        <source>locked</source>
        <translation>gesperrt</translation>
    </message>
    <message>
        <source>unlocked</source>
        <translation>entsperrt</translation>
    </message>
    <message>
        <source>PIN changed</source>
        <translation>PIN geändert</translation>
    </message>
    <message>
        <source>log read</source>
        <translation>Protokoll eingesehen</translation>
    </message>
    <message>
        <source>1 session</source>
        <translation>1 Sitzung</translation>
    </message>
    <message>
        <source>from the command line</source>
        <translation>über die Befehlszeile</translation>
    </message>
    <message>
        <source>Records past their retention period</source>
        <translation>Abgelaufene Aufbewahrungsfristen</translation>
    </message>
    <message>
        <source>completed later</source>
        <translation>später abgeschlossen</translation>
    </message>
</context>
<context>
    <name>RecordingControls</name>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Pain</source>
        <translation>Schmerz</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Pain {score}</source>
        <translation>Schmerz {score}</translation>
    </message>
    <message>
        <source>Passive</source>
        <translation>Passiv</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Play and record</source>
        <translation>Abspielen und aufnehmen</translation>
    </message>
    <message>
        <source>Record</source>
        <translation>Aufnehmen</translation>
    </message>
    <message>
        <source>Stop and next exercise</source>
        <translation>Beenden, nächste Übung</translation>
    </message>
    <message>
        <source>Stop and review</source>
        <translation>Beenden und auswerten</translation>
    </message>
    <message>
        <source>Starting in {seconds} (cancel)</source>
        <translation>Beginn in {seconds} (abbrechen)</translation>
    </message>
    <message>
        <source>Space · pedal</source>
        <translation>Leertaste · Pedal</translation>
    </message>
    <message>
        <source>Saving…</source>
        <translation>Wird gespeichert…</translation>
    </message>
</context>
<context>
    <name>RecordingPill</name>
    <message>
        <source>Recording {time}</source>
        <translation>Aufnahme {time}</translation>
    </message>
    <message>
        <source>Paused at {time}</source>
        <translation>Angehalten bei {time}</translation>
    </message>
</context>
<context>
    <name>RecordsCard</name>
    <message>
        <source>Records</source>
        <translation>Aufbewahrung</translation>
    </message>
    <message>
        <source>Enter the retention period that the law requires after the last session.</source>
        <translation>Geben Sie die gesetzliche Aufbewahrungsfrist nach der letzten Sitzung ein.</translation>
    </message>
    <message>
        <source>Not set</source>
        <translation>Nicht festgelegt</translation>
    </message>
    <message>
        <source>{n} years</source>
        <translation>{n} Jahre</translation>
    </message>
    <message>
        <source>&amp;Archive…</source>
        <translation>&amp;Archiv…</translation>
    </message>
    <message>
        <source>&amp;Log…</source>
        <translation>&amp;Protokoll…</translation>
    </message>
    <message>
        <source>Past r&amp;etention period…</source>
        <translation>Abgelaufene &amp;Fristen…</translation>
    </message>
</context>
<context>
    <name>RecordsDialog</name>
    <message>
        <source>Done</source>
        <translation>Fertig</translation>
    </message>
    <message>
        <source>Restore</source>
        <translation>Wiederherstellen</translation>
    </message>
    <message>
        <source>Delete…</source>
        <translation>Löschen…</translation>
    </message>
    <message>
        <source>Archive</source>
        <translation>Archivieren</translation>
    </message>
</context>
<context>
    <name>ReportCard</name>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>Name, address and logo of the clinic appear at the top of every page. Empty fields are not printed.</source>
        <translation>Name, Anschrift und Logo der Einrichtung stehen oben auf jeder Seite. Leere Felder werden nicht gedruckt.</translation>
    </message>
    <message>
        <source>Clinic name</source>
        <translation>Name der Einrichtung</translation>
    </message>
    <message>
        <source>Address, up to four lines</source>
        <translation>Anschrift, bis zu vier Zeilen</translation>
    </message>
    <message>
        <source>Logo</source>
        <translation>Logo</translation>
    </message>
    <message>
        <source>Choose a logo…</source>
        <translation>Logo wählen…</translation>
    </message>
    <message>
        <source>Remove logo</source>
        <translation>Logo entfernen</translation>
    </message>
    <message>
        <source>Paper</source>
        <translation>Papier</translation>
    </message>
    <message>
        <source>US Letter</source>
        <translation>US Letter</translation>
    </message>
    <message>
        <source>Images (*.png *.jpg *.jpeg)</source>
        <translation>Bilder (*.png *.jpg *.jpeg)</translation>
    </message>
    <message>
        <source>Choose a logo</source>
        <translation>Logo wählen</translation>
    </message>
    <message>
        <source>Print real name, birth date and record number</source>
        <translation>Echten Namen, Geburtsdatum und Aktennummer drucken</translation>
    </message>
</context>
<context>
    <name>ReportPanel</name>
    <message>
        <source>Comment</source>
        <translation>Kommentar</translation>
    </message>
    <message>
        <source>Printed on the report and saved with the session. No names here, please.</source>
        <translation>Steht auf dem Bericht und wird mit der Sitzung gespeichert. Bitte keine Namen.</translation>
    </message>
    <message>
        <source>Comment on the report</source>
        <translation>Kommentar im Bericht</translation>
    </message>
    <message>
        <source>Sentence to insert</source>
        <translation>Satz zum Einfügen</translation>
    </message>
    <message>
        <source>Search the saved sentences</source>
        <translation>Gespeicherte Sätze durchsuchen</translation>
    </message>
    <message>
        <source>Insert</source>
        <translation>Einfügen</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Löschen</translation>
    </message>
    <message>
        <source>Parts of the report</source>
        <translation>Teile des Berichts</translation>
    </message>
    <message>
        <source>Use these parts for all reports</source>
        <translation>Für alle Berichte so verwenden</translation>
    </message>
    <message>
        <source>Placeholders for the session’s values: {places}</source>
        <translation>Diese Platzhalter werden durch Werte der Sitzung ersetzt: {places}</translation>
    </message>
    <message>
        <source>Warnings, method and the legal notice are always printed.</source>
        <translation>Warnungen, Verfahren und der rechtliche Hinweis werden immer gedruckt.</translation>
    </message>
</context>
<context>
    <name>ReportScreen</name>
    <message>
        <source>Save PDF…</source>
        <translation>PDF speichern…</translation>
    </message>
    <message>
        <source>Open the PDF</source>
        <translation>PDF öffnen</translation>
    </message>
    <message>
        <source>Print…</source>
        <translation>Drucken…</translation>
    </message>
    <message>
        <source>Letter to the doctor…</source>
        <translation>Arztbrief…</translation>
    </message>
    <message>
        <source>Home exercise sheet…</source>
        <translation>Übungsblatt…</translation>
    </message>
    <message>
        <source>Back to the report</source>
        <translation>Zurück zum Bericht</translation>
    </message>
    <message>
        <source>Preview of the report</source>
        <translation>Vorschau des Berichts</translation>
    </message>
    <message>
        <source>One page of US Letter</source>
        <translation>Eine Seite US Letter</translation>
    </message>
    <message>
        <source>{count} pages of US Letter</source>
        <translation>{count} Seiten US Letter</translation>
    </message>
    <message>
        <source>One page of A4</source>
        <translation>Eine A4-Seite</translation>
    </message>
    <message>
        <source>{count} pages of A4</source>
        <translation>{count} A4-Seiten</translation>
    </message>
    <message>
        <source>Not saved yet</source>
        <translation>Noch nicht gespeichert</translation>
    </message>
    <message>
        <source>Save report</source>
        <translation>Bericht speichern</translation>
    </message>
    <message>
        <source>PDF (*.pdf)</source>
        <translation>PDF (*.pdf)</translation>
    </message>
    <message>
        <source>Saved</source>
        <translation>Gespeichert</translation>
    </message>
    <message>
        <source>{pages}, readable in black and white. Contains the patient’s real name: store it securely.</source>
        <translation>{pages}, auch in Schwarz-Weiß lesbar. Enthält den echten Namen des Patienten: sicher aufbewahren.</translation>
    </message>
    <message>
        <source>{pages}, readable in black and white. Contains the pseudonym, not the real name.</source>
        <translation>{pages}, auch in Schwarz-Weiß lesbar. Enthält das Pseudonym, nicht den echten Namen.</translation>
    </message>
    <message>
        <source>Send to clinic software</source>
        <translation>An Praxissoftware senden</translation>
    </message>
</context>
<context>
    <name>ResultTables</name>
    <message>
        <source>Notes: {notes}</source>
        <translation>Notizen: {notes}</translation>
    </message>
    <message>
        <source>Pain (0–10): {pains}</source>
        <translation>Schmerz (0–10): {pains}</translation>
    </message>
</context>
<context>
    <name>ResultsDialog</name>
    <message>
        <source>&amp;Stop</source>
        <translation>&amp;Stopp</translation>
    </message>
    <message>
        <source>Progress of the re-analysis</source>
        <translation>Fortschritt der neuen Analyse</translation>
    </message>
    <message>
        <source>&amp;Keep old result</source>
        <translation>Altes &amp;behalten</translation>
    </message>
    <message>
        <source>&amp;Use new result</source>
        <translation>&amp;Neues verwenden</translation>
    </message>
    <message>
        <source>Re-analysing: {percent} %</source>
        <translation>Neue Analyse: {percent} %</translation>
    </message>
    <message>
        <source>Continue working</source>
        <translation>Weiterarbeiten</translation>
    </message>
    <message>
        <source>Reading both results…</source>
        <translation>Beide Ergebnisse werden gelesen…</translation>
    </message>
    <message>
        <source>Decide later</source>
        <translation>Später entscheiden</translation>
    </message>
    <message>
        <source>Use the new result?</source>
        <translation>Das neue Ergebnis verwenden?</translation>
    </message>
    <message>
        <source>You can continue working. The old result stays until you choose the new one. “Stop” keeps the old result.</source>
        <translation>Sie können weiterarbeiten. Das alte Ergebnis bleibt, bis Sie das neue wählen. „Stopp“ behält das alte Ergebnis.</translation>
    </message>
</context>
<context>
    <name>RetestDialog</name>
    <message>
        <source>MDC95 from test–retest sessions</source>
        <translation>MDC95 aus Test-Retest-Sitzungen</translation>
    </message>
    <message>
        <source>&amp;Use these values</source>
        <translation>&amp;Diese Werte verwenden</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Unreadable sessions: {count}</source>
        <translation>Nicht lesbare Sitzungen: {count}</translation>
    </message>
    <message>
        <source>Based on people measured more than once, with all markers removed and replaced in between. Shows the standard error of measurement (SEM) and MDC95 with 95 % confidence intervals.</source>
        <translation>Grundlage sind mehrfach gemessene Personen, deren Marker dazwischen alle entfernt und neu geklebt wurden. Gezeigt werden der Standardmessfehler (SEM) und die MDC95 mit 95-%-Konfidenzintervallen.</translation>
    </message>
</context>
<context>
    <name>ReviewCard</name>
    <message>
        <source>Range of motion</source>
        <translation>Bewegungsausmaß</translation>
    </message>
    <message>
        <source>Exclude</source>
        <translation>Ausschließen</translation>
    </message>
    <message>
        <source>The session is kept but not analysed. It can be included again.</source>
        <translation>Die Sitzung bleibt, wird aber nicht ausgewertet. Sie kann wieder eingeschlossen werden.</translation>
    </message>
    <message>
        <source>Side by side…</source>
        <translation>Nebeneinander…</translation>
    </message>
    <message>
        <source>Export…</source>
        <translation>Exportieren…</translation>
    </message>
    <message>
        <source>Make report</source>
        <translation>Zum Bericht</translation>
    </message>
    <message>
        <source>older result, excluded</source>
        <translation>älteres Ergebnis, ausgeschlossen</translation>
    </message>
    <message>
        <source>Include again</source>
        <translation>Wieder einschließen</translation>
    </message>
    <message>
        <source>No other session of this exercise yet.</source>
        <translation>Noch keine andere Sitzung dieser Übung.</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Noch einmal messen</translation>
    </message>
    <message>
        <source>Compare with {hand}, {day} (B)</source>
        <translation>Vergleichen mit: {hand}, {day} (B)</translation>
    </message>
</context>
<context>
    <name>ReviewCharts</name>
    <message>
        <source>All fingers</source>
        <translation>Alle Finger</translation>
    </message>
    <message>
        <source>Wrist</source>
        <translation>Handgelenk</translation>
    </message>
</context>
<context>
    <name>ReviewFlow</name>
    <message>
        <source>This result is used from now on.</source>
        <translation>Ab jetzt wird dieses Ergebnis verwendet.</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Save image</source>
        <translation>Bild speichern</translation>
    </message>
    <message>
        <source>The other results were not changed.</source>
        <translation>Die anderen Ergebnisse wurden nicht verändert.</translation>
    </message>
    <message>
        <source>no frame of this session was saved</source>
        <translation>von dieser Sitzung wurde kein Bild gespeichert</translation>
    </message>
    <message>
        <source>The result was saved again as the newest one.</source>
        <translation>Das Ergebnis wurde noch einmal als neuestes gespeichert.</translation>
    </message>
</context>
<context>
    <name>ReviewFrameView</name>
    <message>
        <source>Correct markers…</source>
        <translation>Marker korrigieren…</translation>
    </message>
    <message>
        <source>A marker is wrong or missing here (Shift+F10)</source>
        <translation>Ein Marker ist hier falsch oder fehlt (Umschalt+F10)</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>The angle drawn on the frame (A)</source>
        <translation>Winkel im Bild einzeichnen (A)</translation>
    </message>
    <message>
        <source>Correct…</source>
        <translation>Korrigieren…</translation>
    </message>
    <message>
        <source>Not measured here</source>
        <translation>Hier nicht gemessen</translation>
    </message>
    <message>
        <source>No video was saved: markers only</source>
        <translation>Kein Video gespeichert: nur die Marker</translation>
    </message>
    <message>
        <source>Repetition {number} of {count} · {time}</source>
        <translation>Wiederholung {number} von {count} · {time}</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Speichern…</translation>
    </message>
    <message>
        <source>Image of the hand alone (F)</source>
        <translation>Bild der Hand allein (F)</translation>
    </message>
    <message>
        <source>Moves towards the camera: not drawn</source>
        <translation>Bewegung zur Kamera hin: nicht gezeichnet</translation>
    </message>
</context>
<context>
    <name>ReviewScreen</name>
    <message>
        <source>Reading the session…</source>
        <translation>Sitzung wird gelesen…</translation>
    </message>
    <message>
        <source>This session cannot be read. Go back, or choose another one.</source>
        <translation>Diese Sitzung ist nicht lesbar. Gehen Sie zurück oder wählen Sie eine andere.</translation>
    </message>
</context>
<context>
    <name>SessionChart</name>
    <message>
        <source>Curves of the session</source>
        <translation>Kurven der Sitzung</translation>
    </message>
    <message>
        <source>Repetitions</source>
        <translation>Wiederholungen</translation>
    </message>
    <message>
        <source>Ctrl+wheel: zoom</source>
        <translation>Strg+Mausrad: Zoom</translation>
    </message>
    <message>
        <source>occluded</source>
        <translation>verdeckt</translation>
    </message>
</context>
<context>
    <name>SessionList</name>
    <message>
        <source>Sessions</source>
        <translation>Sitzungen</translation>
    </message>
</context>
<context>
    <name>SessionListModel</name>
    <message>
        <source>ticked</source>
        <translation>angekreuzt</translation>
    </message>
</context>
<context>
    <name>SessionsScreen</name>
    <message>
        <source>No session yet.</source>
        <translation>Noch keine Sitzung.</translation>
    </message>
    <message>
        <source>Open in review</source>
        <translation>Auswertung öffnen</translation>
    </message>
    <message>
        <source>&amp;Move to another patient…</source>
        <translation>Anderem &amp;Patienten zuordnen…</translation>
    </message>
    <message>
        <source>Change the &amp;exercise…</source>
        <translation>Übung ä&amp;ndern…</translation>
    </message>
    <message>
        <source>Archive or &amp;delete…</source>
        <translation>Ar&amp;chivieren oder löschen…</translation>
    </message>
    <message>
        <source>Sessions of {name}</source>
        <translation>Sitzungen von {name}</translation>
    </message>
    <message>
        <source>Reading…</source>
        <translation>Wird gelesen…</translation>
    </message>
    <message>
        <source>&amp;Include again</source>
        <translation>Wieder &amp;einschließen</translation>
    </message>
    <message>
        <source>E&amp;xclude…</source>
        <translation>Au&amp;sschließen…</translation>
    </message>
    <message>
        <source>Which patient does this session belong to?</source>
        <translation>Zu welchem Patienten gehört diese Sitzung?</translation>
    </message>
    <message>
        <source>Move</source>
        <translation>Zuordnen</translation>
    </message>
    <message>
        <source>Repetitions and values are calculated again. The recording itself is not changed.</source>
        <translation>Wiederholungen und Werte werden neu berechnet. Die Aufnahme selbst ändert sich nicht.</translation>
    </message>
    <message>
        <source>Change exercise</source>
        <translation>Übung ändern</translation>
    </message>
    <message>
        <source>Which exercise was it?</source>
        <translation>Welche Übung war es?</translation>
    </message>
    <message>
        <source>In the archi&amp;ve: {n}</source>
        <translation>&amp;Im Archiv: {n}</translation>
    </message>
    <message>
        <source>Show &amp;progress</source>
        <translation>&amp;Verlauf anzeigen</translation>
    </message>
    <message>
        <source>The session will move from {name}’s progress to the other patient’s.</source>
        <translation>Die Sitzung wechselt vom Verlauf von {name} in den des anderen Patienten.</translation>
    </message>
    <message>
        <source>Tick two sessions to compare</source>
        <translation>Zwei ankreuzen zum Vergleichen</translation>
    </message>
    <message>
        <source>Tick one more session to compare</source>
        <translation>Noch eine Sitzung ankreuzen</translation>
    </message>
    <message>
        <source>Compare the 2 ticked sessions</source>
        <translation>Die 2 angekreuzten vergleichen</translation>
    </message>
</context>
<context>
    <name>SetDialog</name>
    <message>
        <source>No patient names</source>
        <translation>Keine Namen von Patienten</translation>
    </message>
    <message>
        <source>Name of the set</source>
        <translation>Name der Folge</translation>
    </message>
    <message>
        <source>Add an exercise</source>
        <translation>Übung hinzufügen</translation>
    </message>
    <message>
        <source>Delete this set</source>
        <translation>Diese Folge löschen</translation>
    </message>
    <message>
        <source>Save the set</source>
        <translation>Folge speichern</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Exercise</source>
        <translation>Übung</translation>
    </message>
    <message>
        <source>How much</source>
        <translation>Wie viel</translation>
    </message>
    <message>
        <source>Rest after it</source>
        <translation>Pause danach</translation>
    </message>
    <message>
        <source>New set</source>
        <translation>Neue Folge</translation>
    </message>
    <message>
        <source>Another set has this name.</source>
        <translation>Eine andere Folge heißt schon so.</translation>
    </message>
    <message>
        <source>Delete “{name}”? Press again</source>
        <translation>„{name}“ löschen? Noch einmal drücken</translation>
    </message>
    <message>
        <source>Exercise set</source>
        <translation>Übungsfolge</translation>
    </message>
    <message>
        <source>Exercise sets</source>
        <translation>Übungsfolgen</translation>
    </message>
    <message>
        <source>Exercises that run one after the other with the same markers. Each is saved as its own session.</source>
        <translation>Übungen, die mit denselben Markern nacheinander ausgeführt werden. Jede wird als eigene Sitzung gespeichert.</translation>
    </message>
    <message>
        <source>Enter a name for the set.</source>
        <translation>Geben Sie einen Namen für die Folge ein.</translation>
    </message>
    <message>
        <source>Add an exercise to the set.</source>
        <translation>Fügen Sie der Folge eine Übung hinzu.</translation>
    </message>
</context>
<context>
    <name>SettingsFlow</name>
    <message>
        <source>Folder with the test–retest sessions</source>
        <translation>Ordner mit den Test-Retest-Sitzungen</translation>
    </message>
</context>
<context>
    <name>SettingsScreen</name>
    <message>
        <source>Light</source>
        <translation>Hell</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Dunkel</translation>
    </message>
    <message>
        <source>Change…</source>
        <translation>Ändern…</translation>
    </message>
    <message>
        <source>Hands-free start: use a pedal or a presentation remote (Page Down). An automatic start is counted down, and Space cancels it.</source>
        <translation>Start mit freien Händen: Verwenden Sie ein Pedal oder einen Presenter (Bild ab). Vor einem automatischen Start läuft ein Countdown. Die Leertaste bricht ihn ab.</translation>
    </message>
    <message>
        <source>Calculate from test–retest sessions…</source>
        <translation>Aus Test-Retest-Sitzungen berechnen…</translation>
    </message>
    <message>
        <source>Match system</source>
        <translation>Wie das System</translation>
    </message>
    <message>
        <source>ISB: flexion first</source>
        <translation>ISB: Flexion zuerst</translation>
    </message>
    <message>
        <source>On key press</source>
        <translation>Mit Tastendruck</translation>
    </message>
    <message>
        <source>3 s after key press</source>
        <translation>3 s nach Tastendruck</translation>
    </message>
    <message>
        <source>When the hand is still</source>
        <translation>Wenn die Hand ruhig ist</translation>
    </message>
    <message>
        <source>Beep at the goal</source>
        <translation>Ton am Ziel</translation>
    </message>
    <message>
        <source>Off</source>
        <translation>Aus</translation>
    </message>
    <message>
        <source>Stream live values</source>
        <translation>Live-Werte senden</translation>
    </message>
    <message>
        <source>Appearance</source>
        <translation>Darstellung</translation>
    </message>
    <message>
        <source>Carpus never checks for updates online. Compare this version with the latest one where you got Carpus. Back up, then install it over this one. Patients, sessions and settings stay.</source>
        <translation>Carpus sucht nie online nach Aktualisierungen. Ob es eine neuere Version gibt, sehen Sie dort, wo Sie Carpus erhalten haben. Erstellen Sie eine Sicherung, und installieren Sie die neue Version über die vorhandene. Patienten, Sitzungen und Einstellungen bleiben.</translation>
    </message>
    <message>
        <source>Components and licences</source>
        <translation>Komponenten und Lizenzen</translation>
    </message>
    <message>
        <source>Appearance and language</source>
        <translation>Darstellung und Sprache</translation>
    </message>
    <message>
        <source>No sound</source>
        <translation>Kein Ton</translation>
    </message>
    <message>
        <source>For research</source>
        <translation>Für die Forschung</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>Fertig</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Colours</source>
        <translation>Farben</translation>
    </message>
    <message>
        <source>Text size</source>
        <translation>Textgröße</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Sprache</translation>
    </message>
    <message>
        <source>Angle order</source>
        <translation>Winkelreihenfolge</translation>
    </message>
    <message>
        <source>Order of the wrist angles in review, progress and reports. Session files keep the papers’ order (ZYX). Sessions with different orders are not compared.</source>
        <translation>Reihenfolge der Handgelenkwinkel in Auswertung, Verlauf und Berichten. Sitzungsdateien behalten die Reihenfolge der Fachartikel (ZYX). Sitzungen mit verschiedener Reihenfolge werden nicht verglichen.</translation>
    </message>
    <message>
        <source>Streams angles, positions and events over Lab Streaming Layer (LSL). Any computer on the network can read them. Names and images are not included. Applies from the next set-up.</source>
        <translation>Sendet Winkel, Positionen und Ereignisse über Lab Streaming Layer (LSL). Jeder Computer im Netz kann sie lesen. Namen und Bilder sind nicht enthalten. Gilt ab der nächsten Messung, die Sie einrichten.</translation>
    </message>
    <message>
        <source>Sessions and patient list. Private to your user account. Nothing leaves this computer.</source>
        <translation>Sitzungen und Patientenliste. Nur Ihrem Benutzerkonto zugänglich. Nichts verlässt diesen Computer.</translation>
    </message>
    <message>
        <source>Data</source>
        <translation>Daten</translation>
    </message>
    <message>
        <source>Research</source>
        <translation>Forschung</translation>
    </message>
    <message>
        <source>Other programs</source>
        <translation>Andere Programme</translation>
    </message>
    <message>
        <source>Start of a recording</source>
        <translation>Beginn einer Aufnahme</translation>
    </message>
    <message>
        <source>The patient’s view</source>
        <translation>Die Patientenansicht</translation>
    </message>
    <message>
        <source>About Carpus</source>
        <translation>Über Carpus</translation>
    </message>
    <message>
        <source>Version {version}, MIT licence.</source>
        <translation>Version {version}, MIT-Lizenz.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Messen</translation>
    </message>
    <message>
        <source>Report and clinic</source>
        <translation>Bericht und Briefkopf</translation>
    </message>
    <message>
        <source>Safety</source>
        <translation>Sicherheit</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>Data folder</source>
        <translation>Datenordner</translation>
    </message>
    <message>
        <source>Reading the sessions…</source>
        <translation>Sitzungen werden gelesen…</translation>
    </message>
    <message>
        <source>A second screen or window shows the patient what to do. Open it while measuring. For each exercise, choose whether it speaks to a child or an adult.</source>
        <translation>Ein zweiter Bildschirm oder ein eigenes Fenster zeigt dem Patienten, was zu tun ist. Öffnen Sie die Patientenansicht beim Messen. Bei jeder Übung wählen Sie, ob die Texte für Kinder oder Erwachsene sind.</translation>
    </message>
    <message>
        <source>As published: deviation first</source>
        <translation>Wie veröffentlicht: Radial-/Ulnarduktion zuerst</translation>
    </message>
    <message>
        <source>In the demo, settings apply until it is closed.</source>
        <translation>In der Demo gelten Einstellungen nur bis zum Schließen.</translation>
    </message>
    <message>
        <source>Shows path and axes, speeds, the motion page in reports, all export formats, angle order and streaming. Values do not change.</source>
        <translation>Zeigt Bahn und Achsen, Geschwindigkeiten, die Seite mit Bewegungsdaten in Berichten, alle Exportformate, Winkelreihenfolge und Streaming. Werte ändern sich nicht.</translation>
    </message>
</context>
<context>
    <name>StartAngleDialog</name>
    <message>
        <source>The wrist cannot reach neutral</source>
        <translation>Das Handgelenk erreicht die Neutralstellung nicht</translation>
    </message>
    <message>
        <source>Use these angles</source>
        <translation>Diese Winkel verwenden</translation>
    </message>
    <message>
        <source>Enter the wrist and forearm angles now, measured with a goniometer. Palm flat on the table is 90° pronation. Carpus adds them to all wrist angles and notes it in the report. Bent fingers need no entry.</source>
        <translation>Messen Sie jetzt die Winkel von Handgelenk und Unterarm mit dem Goniometer und tragen Sie sie ein. Die Handfläche flach auf dem Tisch entspricht 90° Pronation. Carpus rechnet sie in alle Handgelenkwinkel ein und vermerkt es im Bericht. Gebeugte Finger brauchen keinen Eintrag.</translation>
    </message>
    <message>
        <source>Wrist is in neutral</source>
        <translation>Handgelenk ist in Neutralstellung</translation>
    </message>
</context>
<context>
    <name>StraightFingers</name>
    <message>
        <source>Are the fingers straight?</source>
        <translation>Sind die Finger gestreckt?</translation>
    </message>
    <message>
        <source>{finger} bent</source>
        <translation>{finger} gebeugt</translation>
    </message>
    <message>
        <source>Click a finger that cannot fully extend (keys 1 to 5).</source>
        <translation>Klicken Sie einen Finger an, der sich nicht ganz strecken lässt (Tasten 1 bis 5).</translation>
    </message>
    <message>
        <source>A bent finger is measured from its own resting position, which is less accurate.</source>
        <translation>Ein gebeugter Finger wird von seiner eigenen Ruhelage aus gemessen und daher weniger genau.</translation>
    </message>
</context>
<context>
    <name>TherapistCard</name>
    <message>
        <source>Initials</source>
        <translation>Kürzel</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Therapists</source>
        <translation>Therapeutinnen und Therapeuten</translation>
    </message>
    <message>
        <source>Sessions, reports, letters and the log carry the therapist’s initials. Choose the therapist in the top bar. Clear the initials to remove a therapist.</source>
        <translation>Sitzungen, Berichte, Briefe und Protokoll tragen das Kürzel der Therapeutin oder des Therapeuten. Ausgewählt wird in der oberen Leiste. Um eine Person zu entfernen, löschen Sie ihr Kürzel.</translation>
    </message>
</context>
<context>
    <name>TherapistController</name>
    <message>
        <source>Edit the list…</source>
        <translation>Liste bearbeiten…</translation>
    </message>
</context>
<context>
    <name>TimeSlider</name>
    <message>
        <source>Time in the session</source>
        <translation>Zeit in der Sitzung</translation>
    </message>
</context>
<context>
    <name>TopBar</name>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>Help (F1)</source>
        <translation>Hilfe (F1)</translation>
    </message>
    <message>
        <source>Settings (Ctrl+,)</source>
        <translation>Einstellungen (Strg+,)</translation>
    </message>
    <message>
        <source>Hide names (Ctrl+D)</source>
        <translation>Namen ausblenden (Strg+D)</translation>
    </message>
    <message>
        <source>Therapist: {initials}</source>
        <translation>Therapeut/in: {initials}</translation>
    </message>
    <message>
        <source>Choose a therapist</source>
        <translation>Therapeut/in wählen</translation>
    </message>
    <message>
        <source>Therapist</source>
        <translation>Therapeut/in</translation>
    </message>
    <message>
        <source>Show names (Ctrl+D)</source>
        <translation>Namen einblenden (Strg+D)</translation>
    </message>
    <message>
        <source>Available after the recording</source>
        <translation>Nach der Aufnahme verfügbar</translation>
    </message>
</context>
<context>
    <name>TopBarController</name>
    <message>
        <source>Exercise</source>
        <translation>Übung</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Markers</source>
        <translation>Marker</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Messen</translation>
    </message>
    <message>
        <source>Sessions</source>
        <translation>Sitzungen</translation>
    </message>
    <message>
        <source>Review</source>
        <translation>Auswertung</translation>
    </message>
    <message>
        <source>Progress</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>Measured although uncertain: {findings}</source>
        <translation>Trotz Unsicherheit gemessen: {findings}</translation>
    </message>
    <message>
        <source>Saved {time}</source>
        <translation>Gespeichert {time}</translation>
    </message>
    <message>
        <source>Simulated camera</source>
        <translation>Simulierte Kamera</translation>
    </message>
    <message>
        <source>Recording {name}</source>
        <translation>Aufnahme {name}</translation>
    </message>
    <message>
        <source>Camera ready</source>
        <translation>Kamera bereit</translation>
    </message>
    <message>
        <source>No camera</source>
        <translation>Keine Kamera</translation>
    </message>
    <message>
        <source>{percent} %</source>
        <translation>{percent} %</translation>
    </message>
    <message>
        <source>{count} new results: choose</source>
        <translation>{count} neue Ergebnisse: wählen</translation>
    </message>
    <message>
        <source>Choose</source>
        <translation>Wählen</translation>
    </message>
    <message>
        <source>{count} fps</source>
        <translation>{count} fps</translation>
    </message>
    <message>
        <source>{count} fps (below {least})</source>
        <translation>{count} fps (unter {least})</translation>
    </message>
    <message>
        <source>This session is excluded from analysis.</source>
        <translation>Diese Sitzung ist von der Auswertung ausgeschlossen.</translation>
    </message>
    <message>
        <source>Re-analysing {percent}</source>
        <translation>Neue Analyse {percent}</translation>
    </message>
    <message>
        <source>Progress and Stop</source>
        <translation>Fortschritt und Stopp</translation>
    </message>
    <message>
        <source>Old and new result overlaid</source>
        <translation>Alt und neu übereinander</translation>
    </message>
    <message>
        <source>New result: choose one</source>
        <translation>Neues Ergebnis: altes oder neues wählen</translation>
    </message>
    <message>
        <source>Space for {time}</source>
        <translation>Platz für {time}</translation>
    </message>
    <message>
        <source>This is a simulated hand, not {name}. It is excluded from analysis.</source>
        <translation>Dies ist eine simulierte Hand, nicht {name}. Sie ist von der Auswertung ausgeschlossen.</translation>
    </message>
    <message>
        <source>{words}, {lost} frames dropped</source>
        <translation>{words}, {lost} ausgefallen</translation>
    </message>
    <message>
        <source>The clinic’s server does not respond. Until it does, patients and sessions cannot be shown or changed. You can still measure.</source>
        <translation>Der Server der Einrichtung antwortet nicht. Bis er wieder antwortet, lassen sich Patienten und Sitzungen weder anzeigen noch ändern. Messen ist weiter möglich.</translation>
    </message>
</context>
<context>
    <name>VerdictPanel</name>
    <message>
        <source>good</source>
        <translation>gut</translation>
    </message>
    <message>
        <source>uncertain</source>
        <translation>unsicher</translation>
    </message>
    <message>
        <source>wrong</source>
        <translation>falsch</translation>
    </message>
    <message>
        <source>open</source>
        <translation>offen</translation>
    </message>
</context>
<context>
    <name>VersionChoice</name>
    <message>
        <source>Results of this recording</source>
        <translation>Ergebnisse dieser Aufnahme</translation>
    </message>
    <message>
        <source>{number} · {day}</source>
        <translation>{number} · {day}</translation>
    </message>
    <message>
        <source>{result}, in use</source>
        <translation>{result}, verwendet</translation>
    </message>
    <message>
        <source>Use this result</source>
        <translation>Dieses Ergebnis verwenden</translation>
    </message>
</context>
<context>
    <name>WelcomeController</name>
    <message>
        <source>Screen</source>
        <translation>Bildschirm</translation>
    </message>
    <message>
        <source>Install Carpus again: part of it is missing or damaged.</source>
        <translation>Installieren Sie Carpus neu: Ein Teil fehlt oder ist beschädigt.</translation>
    </message>
    <message>
        <source>Fonts</source>
        <translation>Schriften</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Camera driver</source>
        <translation>Kameratreiber</translation>
    </message>
    <message>
        <source>Data folder</source>
        <translation>Datenordner</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Speicherplatz</translation>
    </message>
    <message>
        <source>Camera permissions</source>
        <translation>Kamerarechte</translation>
    </message>
    <message>
        <source>In the display settings, choose a higher resolution or a smaller scale: {width} × {height} or more.</source>
        <translation>Wählen Sie in den Anzeigeeinstellungen eine höhere Auflösung oder eine kleinere Skalierung: {width} × {height} oder mehr.</translation>
    </message>
    <message>
        <source>the fonts of Carpus cannot be loaded</source>
        <translation>die Schriften von Carpus lassen sich nicht laden</translation>
    </message>
    <message>
        <source>{width} × {height} usable</source>
        <translation>{width} × {height} nutzbar</translation>
    </message>
</context>
<context>
    <name>WelcomePanel</name>
    <message>
        <source>Another &amp;folder…</source>
        <translation>Anderer &amp;Ordner…</translation>
    </message>
    <message>
        <source>Close Carpus</source>
        <translation>Carpus schließen</translation>
    </message>
    <message>
        <source>&amp;Look again</source>
        <translation>&amp;Erneut prüfen</translation>
    </message>
    <message>
        <source>&amp;Details</source>
        <translation>&amp;Details</translation>
    </message>
    <message>
        <source>&amp;Guide me through a first session</source>
        <translation>Durch eine erste Sitzung &amp;führen</translation>
    </message>
    <message>
        <source>Not now</source>
        <translation>Jetzt nicht</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Welcome to Carpus</source>
        <translation>Willkommen bei Carpus</translation>
    </message>
    <message>
        <source>Patients and sessions are saved here. Nothing leaves this computer.</source>
        <translation>Patienten und Sitzungen werden hier gespeichert. Nichts verlässt diesen Computer.</translation>
    </message>
    <message>
        <source>Checking this computer …</source>
        <translation>Dieser Computer wird geprüft …</translation>
    </message>
    <message>
        <source>This computer has everything that Carpus needs.</source>
        <translation>Dieser Computer hat alles, was Carpus braucht.</translation>
    </message>
    <message>
        <source>One thing needs your attention. The practice patient works without it.</source>
        <translation>Ein Punkt ist noch offen. Für den Testpatienten ist das nicht nötig.</translation>
    </message>
    <message>
        <source>{count} things need your attention. The practice patient works without them.</source>
        <translation>{count} Punkte sind noch offen. Für den Testpatienten ist das nicht nötig.</translation>
    </message>
    <message>
        <source>The new folder is used from the next start. Close Carpus and open it again before you measure.</source>
        <translation>Der Ordner gilt ab dem nächsten Start: Schließen Sie Carpus und öffnen Sie es wieder, bevor Sie messen.</translation>
    </message>
    <message>
        <source>Pseudonym only</source>
        <translation>Nur das Pseudonym</translation>
    </message>
    <message>
        <source>Real name too</source>
        <translation>Auch den echten Namen</translation>
    </message>
    <message>
        <source>What should reports and letters print?</source>
        <translation>Was soll auf Berichten und Briefen stehen?</translation>
    </message>
</context>
<context>
    <name>ZoomChart</name>
    <message>
        <source>Zoom, copy and save</source>
        <translation>Vergrößern, kopieren, speichern</translation>
    </message>
</context>
<context>
    <name>_EmptyView</name>
    <message>
        <source>No patient “{name}”.</source>
        <translation>Kein Patient „{name}“.</translation>
    </message>
    <message>
        <source>Create “{name}”</source>
        <translation>„{name}“ anlegen</translation>
    </message>
    <message>
        <source>No patients yet. Add the first one, or try everything with the practice patient.</source>
        <translation>Noch keine Patienten. Legen Sie den ersten an, oder probieren Sie alles mit dem Testpatienten.</translation>
    </message>
</context>
<context>
    <name>_OfflineView</name>
    <message>
        <source>Measure “{name}”</source>
        <translation>„{name}“ messen</translation>
    </message>
    <message>
        <source>Measure without the patient list</source>
        <translation>Ohne die Patientenliste messen</translation>
    </message>
    <message>
        <source>The patient list returns when the server responds. To measure now, enter the patient’s pseudonym above. The session is saved and appears in the list later.</source>
        <translation>Die Patientenliste erscheint wieder, sobald der Server antwortet. Um jetzt zu messen, geben Sie oben das Pseudonym ein. Die Sitzung wird gespeichert und erscheint später in der Liste.</translation>
    </message>
</context>
</TS>
